// SPDX-License-Identifier: MIT
/// Kernels for processors with AVX2: lanes of width 8.
#include "kernels/body_passes.h"
#include "kernels/contact_tables.h"
#include "kernels/joint_tables.h"
#include "kernels/kernel_tables.h"
#include "kernels/point_passes.h"
#include "kernels/tree_passes.h"

namespace plumb::kernels {

template <>
const ContactKernels<float, 8>* kernel_table() {
    static constexpr auto table = all_contact_kernels<float, 8>();
    return table.data();
}
template <>
const JointKernels<float, 8>* kernel_table() {
    static constexpr auto table = all_joint_kernels<float, 8>();
    return &table;
}
template <>
const PointKernels<float, 8>* kernel_table() {
    static constexpr auto table = all_point_kernels<float, 8>(Formulas());
    return &table;
}

template <>
const ContactKernels<double, 8>* kernel_table() {
    static constexpr auto table = all_contact_kernels<double, 8>();
    return table.data();
}
template <>
const JointKernels<double, 8>* kernel_table() {
    static constexpr auto table = all_joint_kernels<double, 8>();
    return &table;
}
template <>
const PointKernels<double, 8>* kernel_table() {
    static constexpr auto table = all_point_kernels<double, 8>(Formulas());
    return &table;
}

template <>
const BodyKernels* body_kernel_table<8>() {
    static constexpr auto table = all_body_kernels<kBodyLanes<8>>();
    return &table;
}

template <>
const TreeKernels<8>* kernel_table() {
    static constexpr auto table = all_tree_kernels<8>();
    return &table;
}

template <>
const FrontKernels* front_kernel_table<4>() {
    static constexpr auto table = front_kernels_of<4>();
    return &table;
}

}  // namespace plumb::kernels
