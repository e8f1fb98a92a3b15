// SPDX-License-Identifier: MIT
/// How the units of each instruction set hand over their kernels.
///
/// Each unit specialises `kernel_table` for what it holds. All its other symbols are made local
/// when it is linked (cmake/PlumbKernels.cmake), so that a template compiled for a newer processor
/// can never stand in for the same template of the baseline.
#pragma once

#include "kernels/body_kernels.h"
#include "math/dense_front.h"

namespace plumb::kernels {

template <class Table>
const Table* kernel_table();

/// `Lanes`: of the rows' kernels of the same unit.
template <int Lanes>
const BodyKernels* body_kernel_table();
/// `W`: doubles in a register of the unit.
template <int W>
const FrontKernels* front_kernel_table();

}  // namespace plumb::kernels
