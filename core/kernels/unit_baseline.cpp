// SPDX-License-Identifier: MIT
/// Kernels for every x86-64 processor: lanes of width 1 and 4.
#include "kernels/ball_passes.h"
#include "kernels/contact_passes.h"
#include "kernels/kernel_tables.h"

namespace plumb::kernels {

template <>
const ContactKernels<float, 1>* kernel_table() {
    return kVariants<float, 1>;
}
template <>
const BallKernels<float, 1>* kernel_table() {
    return &kBallKernels<float, 1>;
}

template <>
const ContactKernels<double, 1>* kernel_table() {
    return kVariants<double, 1>;
}
template <>
const BallKernels<double, 1>* kernel_table() {
    return &kBallKernels<double, 1>;
}

template <>
const ContactKernels<float, 4>* kernel_table() {
    return kVariants<float, 4>;
}
template <>
const BallKernels<float, 4>* kernel_table() {
    return &kBallKernels<float, 4>;
}

template <>
const ContactKernels<double, 4>* kernel_table() {
    return kVariants<double, 4>;
}
template <>
const BallKernels<double, 4>* kernel_table() {
    return &kBallKernels<double, 4>;
}

}  // namespace plumb::kernels
