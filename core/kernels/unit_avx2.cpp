// SPDX-License-Identifier: MIT
/// Kernels for processors with AVX2: lanes of width 8.
#include "kernels/ball_passes.h"
#include "kernels/contact_passes.h"
#include "kernels/kernel_tables.h"

namespace plumb::kernels {

template <>
const ContactKernels<float, 8>* kernel_table() {
    return kVariants<float, 8>;
}
template <>
const BallKernels<float, 8>* kernel_table() {
    return &kBallKernels<float, 8>;
}

template <>
const ContactKernels<double, 8>* kernel_table() {
    return kVariants<double, 8>;
}
template <>
const BallKernels<double, 8>* kernel_table() {
    return &kBallKernels<double, 8>;
}

}  // namespace plumb::kernels
