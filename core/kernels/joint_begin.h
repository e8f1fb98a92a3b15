// SPDX-License-Identifier: MIT
/// Where joints stand at the start of a substep, from the poses in double precision. Included by
/// the units of each instruction set and by nothing else.
#pragma once

#include "constraints/joint_lever.h"
#include "kernels/item_group.h"
#include "schedule/joint_blocks.h"

namespace plumb::kernels {

/// `N` of the lanes of an array in a block, from `first` on, in the rows' precision.
template <int N, class Real, int W>
inline void store_part(Real (&to)[W], int first, const Number<double, N>& x) {
    alignas(64) double lanes[N];
    store(lanes, x);
    for (int i = 0; i < N; ++i) to[first + i] = static_cast<Real>(lanes[i]);
}
template <int N, class Real, int W>
inline void store_part(Real (&to)[3][W], int first, const Vector3<Number<double, N>>& v) {
    for (int k = 0; k < 3; ++k) store_part<N>(to[k], first, v[k]);
}
template <int N, class Real, int W>
inline void store_part(Real (&to)[6][W], int first, const Symmetric3<Number<double, N>>& m) {
    const Number<double, N> x[6] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
    for (int k = 0; k < 6; ++k) store_part<N>(to[k], first, x[k]);
}
template <int N, class Real, int W>
inline Number<double, N> load_part(const Real (&from)[W], int first) {
    alignas(64) double lanes[N];
    for (int i = 0; i < N; ++i) lanes[i] = static_cast<double>(from[first + i]);
    return load(lanes);
}
template <int N, class Real, int W>
inline Vector3<Number<double, N>> load_part(const Real (&from)[3][W], int first) {
    return {load_part<N>(from[0], first), load_part<N>(from[1], first),
            load_part<N>(from[2], first)};
}

/// How the lever of a ball joint turns, in a tree or iterated; it rests on what cannot be moved.
/// `arm`: world frame [m]; `impulse`: of the substep before [N s].
template <int N, bool Tree, class T = Number<double, N>>
inline JointLever<T> ball_lever(const BodyStates& columns, const ItemGroup<N>& bodies,
                                const Vector3<T>& arm, const T& impulse, double h) {
    const T load =
        lever_load<T>(impulse, T(0), arm, bodies.symmetric(columns.world_inverse_inertia), T(h));
    const T moves = select_greater(bodies.number(columns.inverse_mass), T(0), T(1), T(0));
    const Vector3<T> turn = bodies.vector(columns.angular_velocity_now) * T(h);
    JointLever<T> lever;
    if constexpr (Tree)
        lever = exact_lever<T>(load, swing_squared<T>(turn, arm), turn, [&]() -> Vector3<T> {
            return bodies.vector(columns.angular_velocity_before) * T(h);
        });
    else
        lever = iterated_lever<T>(load, turn);
    return {lever.share * moves, lever.lag * moves};
}

/// One side of N joints: its point, and how its body takes an impulse there.
template <int N>
struct JointSide {
    using T = Number<double, N>;
    Vector3<T> arm, point;
    T inverse_mass;
    JointLever<T> lever;
    Symmetric3<T> inverse_inertia;

    /// `used`: 0 for lanes that are to stay without a body.
    JointSide(const BodyStates& columns, const ItemGroup<N>& bodies, const Vector3<T>& local,
              const T& used, const T& impulse, double h) {
        arm = (bodies.rotation(columns.orientation) * local) * used;
        point = bodies.vector(columns.position) * used + arm;
        inverse_mass = bodies.number(columns.inverse_mass) * used;
        const Symmetric3<T> i = bodies.symmetric(columns.world_inverse_inertia);
        inverse_inertia = {i.xx * used, i.yy * used, i.zz * used,
                           i.xy * used, i.xz * used, i.yz * used};
        lever = ball_lever<N, false>(columns, bodies, arm, impulse, h);
    }
};

template <int N, class Real, int W>
inline void begin_part(BallBlock<Real, W>& block, const BallFrames<W>& frames,
                       const BodyStates& bodies, double h, int first) {
    using T = Number<double, N>;
    const T impulse = load_part<N>(frames.load, first);
    const T used = load_part<N>(frames.used, first), held = load_part<N>(frames.held, first);
    const Vector3<T> local_b = load_part<N>(frames.point_b, first);
    const JointSide<N> a(bodies, ItemGroup<N>(frames.body_a + first),
                         load_part<N>(frames.point_a, first), used, impulse, h);
    const JointSide<N> b(bodies, ItemGroup<N>(frames.body_b + first), local_b, used * (T(1) - held),
                         impulse, h);
    store_part<N>(block.arm_a, first, a.arm), store_part<N>(block.arm_b, first, b.arm);
    store_part<N>(block.gap, first, Vector3<T>(a.point - (b.point + local_b * (used * held))));
    store_part<N>(block.inverse_mass_a, first, a.inverse_mass);
    store_part<N>(block.inverse_mass_b, first, b.inverse_mass);
    store_part<N>(block.inverse_inertia_a, first, a.inverse_inertia);
    store_part<N>(block.inverse_inertia_b, first, b.inverse_inertia);
    store_part<N>(block.share_a, first, a.lever.share);
    store_part<N>(block.share_b, first, b.lever.share);
    store_part<N>(block.lag_a, first, a.lever.lag), store_part<N>(block.lag_b, first, b.lever.lag);
    store_part<N>(block.used, first, used);
    store_part<N>(block.impulse, first, Vector3<T>(T(0), T(0), T(0)));
}

template <class Real, int W>
[[gnu::flatten]] void begin_balls(BallBlock<Real, W>* blocks, const BallFrames<W>* frames,
                                  const BodyStates& bodies, double h, std::size_t count) {
    constexpr int n = kBodyLanes<W>;
    for (std::size_t i = 0; i < count; ++i)
        for (int first = 0; first < W; first += n)
            begin_part<n>(blocks[i], frames[i], bodies, h, first);
}

}  // namespace plumb::kernels
