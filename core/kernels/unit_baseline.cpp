// SPDX-License-Identifier: MIT
/// Kernels for every x86-64 processor: lanes of width 1 and 4.
#include "kernels/ball_passes.h"
#include "kernels/contact_passes.h"
#include "kernels/kernel_tables.h"

namespace plumb::kernels {

template <>
const ContactKernels<float, 1>* kernel_table() {
    static constexpr auto table = all_contact_kernels<float, 1>();
    return table.data();
}
template <>
const BallKernels<float, 1>* kernel_table() {
    static constexpr BallKernels<float, 1> table{solve_balls<float, 1>};
    return &table;
}

template <>
const ContactKernels<double, 1>* kernel_table() {
    static constexpr auto table = all_contact_kernels<double, 1>();
    return table.data();
}
template <>
const BallKernels<double, 1>* kernel_table() {
    static constexpr BallKernels<double, 1> table{solve_balls<double, 1>};
    return &table;
}

template <>
const ContactKernels<float, 4>* kernel_table() {
    static constexpr auto table = all_contact_kernels<float, 4>();
    return table.data();
}
template <>
const BallKernels<float, 4>* kernel_table() {
    static constexpr BallKernels<float, 4> table{solve_balls<float, 4>};
    return &table;
}

template <>
const ContactKernels<double, 4>* kernel_table() {
    static constexpr auto table = all_contact_kernels<double, 4>();
    return table.data();
}
template <>
const BallKernels<double, 4>* kernel_table() {
    static constexpr BallKernels<double, 4> table{solve_balls<double, 4>};
    return &table;
}

}  // namespace plumb::kernels
