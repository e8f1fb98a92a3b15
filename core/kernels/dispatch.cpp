// SPDX-License-Identifier: MIT
/// Hands out kernels, and only those that this processor runs.
#include "kernels/body_kernels.h"
#include "kernels/contact_kernels.h"
#include "kernels/front_kernels.h"
#include "kernels/joint_kernels.h"
#include "kernels/kernel_tables.h"
#include "kernels/point_kernels.h"
#include "kernels/tree_kernels.h"

#include <stdexcept>
#include <string>

namespace plumb {

int widest_lanes() {
#if defined(__x86_64__)
    static const int widest = [] {
        __builtin_cpu_init();
        const bool avx512 =
            __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
        return avx512 ? 16 : __builtin_cpu_supports("avx2") ? 8 : 4;
    }();
    return widest;
#else
    return 4;
#endif
}

namespace {

/// The table of a width; its code is linked in, but is reached only on a processor that runs it.
template <class Table, int W>
const Table* checked_table() {
    if (W > widest_lanes())
        throw std::logic_error("this processor cannot run " + std::to_string(W) + " lanes");
    return kernels::kernel_table<Table>();
}

}  // namespace

template <class Real, int W>
const ContactKernels<Real, W>& contact_kernels(ContactVariant variant) {
    return checked_table<ContactKernels<Real, W>, W>()[static_cast<int>(variant)];
}
template <class Real, int W>
const JointKernels<Real, W>& joint_kernels() {
    return *checked_table<JointKernels<Real, W>, W>();
}

template <class Real, int W>
const PointKernels<Real, W>& point_kernels() {
    return *checked_table<PointKernels<Real, W>, W>();
}

template <int W>
const TreeKernels<W>& tree_kernels() {
    return *checked_table<TreeKernels<W>, W>();
}
template const TreeKernels<1>& tree_kernels<1>();
template const TreeKernels<4>& tree_kernels<4>();
template const TreeKernels<8>& tree_kernels<8>();
template const TreeKernels<16>& tree_kernels<16>();

const BodyKernels& body_kernels(int lanes) {
    switch (lanes) {
        case 1:
            return *kernels::body_kernel_table<1>();
        case 4:
            return *kernels::body_kernel_table<4>();
        case 8:
            return *kernels::body_kernel_table<8>();
        default:
            return *kernels::body_kernel_table<16>();
    }
}

const FrontKernels& front_kernels() {
    switch (widest_lanes()) {
        case 4:
            return *kernels::front_kernel_table<2>();
        case 8:
            return *kernels::front_kernel_table<4>();
        default:
            return *kernels::front_kernel_table<8>();
    }
}

#define PLUMB_INSTANTIATE(Real, W)                                                    \
    template const ContactKernels<Real, W>& contact_kernels<Real, W>(ContactVariant); \
    template const JointKernels<Real, W>& joint_kernels<Real, W>();                   \
    template const PointKernels<Real, W>& point_kernels<Real, W>();
PLUMB_INSTANTIATE(float, 1)
PLUMB_INSTANTIATE(float, 4)
PLUMB_INSTANTIATE(float, 8)
PLUMB_INSTANTIATE(float, 16)
PLUMB_INSTANTIATE(double, 1)
PLUMB_INSTANTIATE(double, 4)
PLUMB_INSTANTIATE(double, 8)
PLUMB_INSTANTIATE(double, 16)
#undef PLUMB_INSTANTIATE

}  // namespace plumb
