// SPDX-License-Identifier: MIT
/// Items of several numbers in columns, such as the bodies', for several of them side by side.
#pragma once

#include "kernels/body_kernels.h"
#include "kernels/item_lanes.h"
#include "math/quaternion.h"
#include "math/symmetric.h"

#include <algorithm>

namespace plumb::kernels {

/// W items, whose columns are read and written together.
template <int W>
struct ItemGroup {
    std::uint32_t at[W];

    explicit ItemGroup(const std::uint32_t* items) {
        for (int i = 0; i < W; ++i) at[i] = items[i];
    }
    /// Those of a list from `first` on; what is left over of the last group repeats the last body.
    ItemGroup(const BodyList& list, std::size_t first) {
        for (int i = 0; i < W; ++i)
            at[i] = list.bodies[std::min(first + static_cast<std::size_t>(i), list.count - 1)];
    }

    template <int N>
    void read(const double* column, Number<double, W> (&to)[N]) const {
        if constexpr (W < 4 || N == 1) {
            alignas(64) double lanes[N][W];
            for (int i = 0; i < W; ++i)
                for (int k = 0; k < N; ++k) lanes[k][i] = column[std::size_t(at[i]) * N + k];
            for (int k = 0; k < N; ++k) to[k] = load(lanes[k]);
        } else {
            ItemLanes<W>::template read<N>(column, at, to);
        }
    }
    template <int N>
    void write(double* column, const Number<double, W> (&from)[N]) const {
        if constexpr (W < 4) {
            alignas(64) double lanes[N][W];
            for (int k = 0; k < N; ++k) store(lanes[k], from[k]);
            for (int i = 0; i < W; ++i)
                for (int k = 0; k < N; ++k) column[std::size_t(at[i]) * N + k] = lanes[k][i];
        } else {
            ItemLanes<W>::template write<N>(column, at, from);
        }
    }

    using T = Number<double, W>;
    T number(const double* column) const {
        T x[1];
        read(column, x);
        return x[0];
    }
    Vector3<T> vector(const double* column) const {
        T x[3];
        read(column, x);
        return Vector3<T>(x[0], x[1], x[2]);
    }
    UnitQuaternion<T> rotation(const double* column) const {
        T x[4];
        read(column, x);
        return {Vector3<T>(x[0], x[1], x[2]), x[3]};
    }
    Symmetric3<T> symmetric(const double* column) const {
        T x[6];
        read(column, x);
        return {x[0], x[1], x[2], x[3], x[4], x[5]};
    }
    void write(double* column, const Vector3<T>& v) const {
        const T x[3] = {v[0], v[1], v[2]};
        write(column, x);
    }
    void write(double* column, const UnitQuaternion<T>& q) const {
        const T x[4] = {q.v[0], q.v[1], q.v[2], q.w};
        write(column, x);
    }
    void write(double* column, const Symmetric3<T>& m) const {
        const T x[6] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
        write(column, x);
    }
};

}  // namespace plumb::kernels
