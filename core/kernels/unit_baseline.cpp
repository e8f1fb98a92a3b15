// SPDX-License-Identifier: MIT
/// Kernels for every x86-64 processor: lanes of width 1 and 4.
#include "kernels/body_passes.h"
#include "kernels/contact_tables.h"
#include "kernels/joint_tables.h"
#include "kernels/kernel_tables.h"
#include "kernels/point_passes.h"
#include "kernels/tree_passes.h"

namespace plumb::kernels {

template <>
const ContactKernels<float, 1>* kernel_table() {
    static constexpr auto table = all_contact_kernels<float, 1>();
    return table.data();
}
template <>
const JointKernels<float, 1>* kernel_table() {
    static constexpr auto table = all_joint_kernels<float, 1>();
    return &table;
}
template <>
const PointKernels<float, 1>* kernel_table() {
    static constexpr auto table = all_point_kernels<float, 1>(Formulas());
    return &table;
}

template <>
const ContactKernels<double, 1>* kernel_table() {
    static constexpr auto table = all_contact_kernels<double, 1>();
    return table.data();
}
template <>
const JointKernels<double, 1>* kernel_table() {
    static constexpr auto table = all_joint_kernels<double, 1>();
    return &table;
}
template <>
const PointKernels<double, 1>* kernel_table() {
    static constexpr auto table = all_point_kernels<double, 1>(Formulas());
    return &table;
}

template <>
const ContactKernels<float, 4>* kernel_table() {
    static constexpr auto table = all_contact_kernels<float, 4>();
    return table.data();
}
template <>
const JointKernels<float, 4>* kernel_table() {
    static constexpr auto table = all_joint_kernels<float, 4>();
    return &table;
}
template <>
const PointKernels<float, 4>* kernel_table() {
    static constexpr auto table = all_point_kernels<float, 4>(Formulas());
    return &table;
}

template <>
const ContactKernels<double, 4>* kernel_table() {
    static constexpr auto table = all_contact_kernels<double, 4>();
    return table.data();
}
template <>
const JointKernels<double, 4>* kernel_table() {
    static constexpr auto table = all_joint_kernels<double, 4>();
    return &table;
}
template <>
const PointKernels<double, 4>* kernel_table() {
    static constexpr auto table = all_point_kernels<double, 4>(Formulas());
    return &table;
}

template <>
const BodyKernels* body_kernel_table<1>() {
    static constexpr auto table = all_body_kernels<kBodyLanes<1>>();
    return &table;
}

template <>
const BodyKernels* body_kernel_table<4>() {
    static constexpr auto table = all_body_kernels<kBodyLanes<4>>();
    return &table;
}

template <>
const TreeKernels<1>* kernel_table() {
    static constexpr auto table = all_tree_kernels<1>();
    return &table;
}

template <>
const TreeKernels<4>* kernel_table() {
    static constexpr auto table = all_tree_kernels<4>();
    return &table;
}

template <>
const FrontKernels* front_kernel_table<2>() {
    static constexpr auto table = front_kernels_of<2>();
    return &table;
}

}  // namespace plumb::kernels
