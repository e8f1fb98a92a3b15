// SPDX-License-Identifier: MIT
/// Kernels for processors with AVX2: lanes of width 8.
#include "kernels/ball_passes.h"
#include "kernels/contact_passes.h"
#include "kernels/kernel_tables.h"

namespace plumb::kernels {

template <>
const ContactKernels<float, 8>* kernel_table() {
    static constexpr auto table = all_contact_kernels<float, 8>();
    return table.data();
}
template <>
const BallKernels<float, 8>* kernel_table() {
    static constexpr BallKernels<float, 8> table{solve_balls<float, 8>};
    return &table;
}

template <>
const ContactKernels<double, 8>* kernel_table() {
    static constexpr auto table = all_contact_kernels<double, 8>();
    return table.data();
}
template <>
const BallKernels<double, 8>* kernel_table() {
    static constexpr BallKernels<double, 8> table{solve_balls<double, 8>};
    return &table;
}

}  // namespace plumb::kernels
