// SPDX-License-Identifier: MIT
/// Kernels for processors with AVX-512: lanes of width 16.
#include "kernels/ball_passes.h"
#include "kernels/contact_passes.h"
#include "kernels/kernel_tables.h"

namespace plumb::kernels {

template <>
const ContactKernels<float, 16>* kernel_table() {
    return kVariants<float, 16>;
}
template <>
const BallKernels<float, 16>* kernel_table() {
    return &kBallKernels<float, 16>;
}

template <>
const ContactKernels<double, 16>* kernel_table() {
    return kVariants<double, 16>;
}
template <>
const BallKernels<double, 16>* kernel_table() {
    return &kBallKernels<double, 16>;
}

}  // namespace plumb::kernels
