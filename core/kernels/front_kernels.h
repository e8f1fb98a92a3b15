// SPDX-License-Identifier: MIT
/// The kernels of sparse elimination (math/dense_front.h), for the widest registers of the
/// processor.
#pragma once

#include "math/dense_front.h"

namespace plumb {

const FrontKernels& front_kernels();

}  // namespace plumb
