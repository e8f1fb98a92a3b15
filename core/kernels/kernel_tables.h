// SPDX-License-Identifier: MIT
/// How the units of each instruction set hand over their kernels.
///
/// Each unit specialises `kernel_table` for what it holds. All its other symbols are made local
/// when it is linked (cmake/PlumbKernels.cmake), so that a template compiled for a newer processor
/// can never stand in for the same template of the baseline.
#pragma once

namespace plumb::kernels {

template <class Table>
const Table* kernel_table();

}  // namespace plumb::kernels
