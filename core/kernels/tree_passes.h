// SPDX-License-Identifier: MIT
/// The loops behind the trees' kernels. Included by the units of each instruction set and by
/// nothing else.
#pragma once

#include "kernels/item_group.h"
#include "kernels/joint_begin.h"
#include "kernels/tree_kernels.h"
#include "math/rotation.h"

#include <limits>

namespace plumb::kernels {

template <int N, class T = Number<double, N>>
inline Symmetric3<T> load_symmetric(const double (&x)[6][N]) {
    return {load(x[0]), load(x[1]), load(x[2]), load(x[3]), load(x[4]), load(x[5])};
}
template <int N, class T = Number<double, N>>
inline void store_symmetric(double (&to)[6][N], const Symmetric3<T>& m) {
    const T x[6] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
    for (int k = 0; k < 6; ++k) store(to[k], x[k]);
}
template <int N, class T = Number<double, N>>
inline Velocity<T> load_velocity(const double (&x)[6][N]) {
    return {Vector3<T>(load(x[0]), load(x[1]), load(x[2])),
            Vector3<T>(load(x[3]), load(x[4]), load(x[5]))};
}
template <int N, class T = Number<double, N>>
inline void store_velocity(double (&to)[6][N], const Velocity<T>& x) {
    for (int k = 0; k < 3; ++k) store(to[k], x.v[k]), store(to[3 + k], x.w[k]);
}

template <int N, class T = Number<double, N>>
inline Velocity<T> read_velocity(const ItemGroup<N>& nodes, const double* table) {
    T x[kTreeVelocity];
    nodes.read(table, x);
    return {Vector3<T>(x[0], x[1], x[2]), Vector3<T>(x[4], x[5], x[6])};
}
template <int N, class T = Number<double, N>>
inline void write_velocity(const ItemGroup<N>& nodes, double* table, const Velocity<T>& y) {
    const T x[kTreeVelocity] = {y.v[0], y.v[1], y.v[2], T(0), y.w[0], y.w[1], y.w[2], T(0)};
    nodes.write(table, x);
}

// ---- begin

/// A joint's point on some bodies, and how the lever of an impulse there turns.
template <int N>
struct TreeSide {
    using T = Number<double, N>;
    Vector3<T> arm, point;
    JointLever<T> lever;

    TreeSide(const BodyStates& b, const ItemGroup<N>& bodies, const Vector3<T>& local,
             const T& impulse, double h) {
        arm = bodies.rotation(b.orientation) * local;
        point = bodies.vector(b.position) + arm;
        lever = ball_lever<N, true>(b, bodies, arm, impulse, h);
    }
};

template <int N>
inline void begin_bodies(TreeBalls<N>& balls, const BodyStates& b, const ItemGroup<N>& bodies,
                         const double (&lift)[3]) {
    using T = Number<double, N>;
    Vector3<T> axes[3];
    bodies.rotation(b.orientation).columns(axes);
    store(balls.mass, T(1) / bodies.number(b.inverse_mass));
    store_symmetric<N>(balls.inertia, rotated_diagonal<T>(axes, bodies.vector(b.inertia)));
    store_velocity<N>(balls.start, {bodies.vector(b.velocity), bodies.vector(b.angular_velocity)});
    const T hung = load(balls.hung);
    for (int k = 0; k < 6; ++k) {
        store(balls.own[k], k < 3 ? T(hung * T(lift[k])) : T(0));
        store(balls.given[k], T(0)), store(balls.written[k], T(0));
    }
}

/// Where the joint's points are. A parent that cannot be moved takes its point along by `shift`.
template <int N>
inline void begin_points(TreeBalls<N>& balls, const BodyStates& b, const ItemGroup<N>& bodies,
                         double h, double most) {
    using T = Number<double, N>;
    const Vector3<T> local = load_vector(balls.other_point);
    const T impulse = load(balls.load);
    const T held = load(balls.held), linked = T(1) - held;
    const ItemGroup<N> others(balls.other);
    const TreeSide<N> own(b, bodies, load_vector(balls.point), impulse, h);
    const TreeSide<N> other(b, others, local, impulse, h);
    const Vector3<T> other_arm = other.arm * linked;
    store_vector(balls.arm, own.arm), store_vector(balls.other_arm, other_arm);
    const Vector3<T> apart = own.point - (other.point * linked + local * held);
    store_vector(balls.apart, apart);
    store_vector(balls.deferred,
                 Vector3<T>(apart * deferred_fraction<T>(dot(apart, apart), T(most))));
    store(balls.share, own.lever.share), store(balls.other_share, T(other.lever.share * linked));
    store_vector(balls.lag, own.lever.lag);
    store_vector(balls.other_lag, Vector3<T>(other.lever.lag * linked));
    const T scripted = select_greater(others.number(b.inverse_mass), T(0), T(0), linked);
    Vector3<T> shift(T(0), T(0), T(0));
    if (any_greater(scripted, T(0))) {
        const UnitQuaternion<T> turn =
            unit_exponential<T>(Vector3<T>(others.vector(b.angular_velocity) * T(h)));
        shift = (others.vector(b.velocity) * T(h) + turn.change(other_arm)) * scripted;
    }
    store_vector(balls.shift, shift);
}

template <int N>
[[gnu::flatten]] void begin_tree(TreeBalls<N>* blocks, std::size_t count, const BodyStates& bodies,
                                 double h, const double (&lift)[3], double most) {
    for (std::size_t i = 0; i < count; ++i) {
        const ItemGroup<N> group(blocks[i].body);
        begin_bodies<N>(blocks[i], bodies, group, lift);
        begin_points<N>(blocks[i], bodies, group, h, most);
    }
}

// ---- evaluate

/// Of a gap's components; infinite where it is not a number.
template <int N, class T = Number<double, N>>
inline T greatest_size(const Vector3<T>& gap) {
    const T size = max(max(gap[0], -gap[0]), max(max(gap[1], -gap[1]), max(gap[2], -gap[2])));
    const T number = (gap[0] + gap[1] + gap[2]) * T(0);
    return select_greater(T(1), number, size, T(std::numeric_limits<double>::infinity()));
}

template <int N>
inline Number<double, N> evaluate_block(TreeBalls<N>& balls, const TreeColumns& tables, double h) {
    using T = Number<double, N>;
    const Velocity<T> start = load_velocity<N>(balls.start), own = load_velocity<N>(balls.own);
    const Vector3<T> v = start.v + own.v, w = start.w + own.w;
    const UnitQuaternion<T> turn = unit_exponential<T>(Vector3<T>(w * T(h)));
    const ItemGroup<N> nodes(balls.node), parents(balls.parent);
    nodes.write(tables.turn, turn);
    write_velocity<N>(nodes, tables.velocity, {v, w});
    const UnitQuaternion<T> other_turn = parents.rotation(tables.turn);
    const Velocity<T> other = read_velocity<N>(parents, tables.velocity);
    const Vector3<T> change = turn.change(load_vector(balls.arm));
    const Vector3<T> other_change = other_turn.change(load_vector(balls.other_arm));
    const Vector3<T> moved = (v - other.v) * T(h);
    const Vector3<T> gap =
        load_vector(balls.apart) + change + moved - other_change - load_vector(balls.shift);
    const Vector3<T> open = gap - load_vector(balls.deferred);
    store_vector(balls.gap, open);
    const T violation = select_greater(load(balls.used), T(0), greatest_size<N>(open), T(0));
    store(balls.violation, violation);
    return violation;
}

template <int N>
[[gnu::flatten]] double evaluate_tree(TreeBalls<N>* blocks, std::size_t count,
                                      const TreeColumns& tables, double h) {
    using T = Number<double, N>;
    T worst = T(0);
    for (std::size_t i = 0; i < count; ++i)
        worst = max(evaluate_block<N>(blocks[i], tables, h), worst);
    double greatest = 0;
    for (int lane = 0; lane < N; ++lane) greatest = max(number_of(worst, lane), greatest);
    return greatest;
}

// ---- eliminate

/// Arms by which the impulse acts: they meet in the point of the joint's a as far as their levers
/// rest.
template <int N, class T = Number<double, N>>
inline void place_impulse(TreeBalls<N>& balls, const TreeColumns& tables, double h) {
    const JointLever<T> lever{load(balls.share), load_vector(balls.lag)};
    const JointLever<T> other{load(balls.other_share), load_vector(balls.other_lag)};
    const T sign = load(balls.sign), is_a = (T(1) + sign) * T(0.5), is_b = T(1) - is_a;
    const T meet = load(balls.meet);
    const Vector3<T> open = load_vector(balls.gap) + load_vector(balls.deferred);
    const Vector3<T> apart = load_vector(balls.apart) * meet, opened = open * meet - apart;
    const Vector3<T> arm = load_vector(balls.arm), other_arm = load_vector(balls.other_arm);
    Vector3<T> acting = arm - (apart + opened * lever.share) * is_b;
    Vector3<T> other_acting = other_arm + (apart + opened * other.share) * is_a;
    if (any_greater(lever.share + other.share, T(0))) {
        const Vector3<T> w = read_velocity<N>(ItemGroup<N>(balls.node), tables.velocity).w;
        const Vector3<T> other_w = read_velocity<N>(ItemGroup<N>(balls.parent), tables.velocity).w;
        acting += unit_exponential<T>(lever.angle(Vector3<T>(w * T(h)))).change(arm);
        other_acting +=
            unit_exponential<T>(other.angle(Vector3<T>(other_w * T(h)))).change(other_arm);
    }
    store_vector(balls.acting, acting);
    store_vector(balls.other_acting, other_acting);
}

template <int N, class T = Number<double, N>>
inline TreeShare<T> read_share(const std::uint32_t (&nodes)[N], const TreeColumns& tables) {
    T x[kShareNumbers];
    ItemGroup<N>(nodes).read(tables.share, x);
    return share_of<T>(x);
}

template <int N, class T = Number<double, N>>
inline void keep_elimination(TreeBalls<N>& balls, const BallElimination<T>& e) {
    store_symmetric<N>(balls.articulated, e.mass);
    store_vector(balls.free, e.free), store_vector(balls.torque, e.torque);
    for (int k = 0; k < 9; ++k) store(balls.across[k], e.across[k / 3][k % 3]);
    const T factors[6] = {e.turn.l10, e.turn.l20, e.turn.l21, e.turn.i0, e.turn.i1, e.turn.i2};
    for (int k = 0; k < 6; ++k) store(balls.turn[k], factors[k]);
}
template <int N, class T = Number<double, N>>
inline BallElimination<T> kept_elimination(const TreeBalls<N>& balls) {
    BallElimination<T> e;
    e.mass = load_symmetric<N>(balls.articulated);
    e.free = load_vector(balls.free), e.torque = load_vector(balls.torque);
    for (int k = 0; k < 9; ++k) e.across[k / 3][k % 3] = load(balls.across[k]);
    e.turn.l10 = load(balls.turn[0]), e.turn.l20 = load(balls.turn[1]);
    e.turn.l21 = load(balls.turn[2]), e.turn.i0 = load(balls.turn[3]);
    e.turn.i1 = load(balls.turn[4]), e.turn.i2 = load(balls.turn[5]);
    return e;
}

/// What the bodies are to their parents.
template <int N, class T = Number<double, N>>
inline void add_to_parents(const TreeBalls<N>& balls, const BallElimination<T>& e,
                           const TreeColumns& tables, double h, bool first) {
    TreeShare<T> parent = first ? TreeShare<T>::none() : read_share<N>(balls.parent, tables);
    const Vector3<T> push = e.free + e.mass * Vector3<T>(load_vector(balls.gap) * T(1 / h));
    const Vector3<T> acting = load_vector(balls.other_acting);
    add_at_point<T>(parent.block, e.mass, acting, push);
    parent.stiffness =
        parent.stiffness + angular_stiffness<T>(acting, Vector3<T>(-load_vector(balls.impulse)),
                                                load(balls.other_share) * T(h));
    T x[kShareNumbers];
    put_share<T>(parent, x);
    ItemGroup<N>(balls.parent).write(tables.share, x);
}

template <int N>
[[gnu::flatten]] void eliminate_tree(TreeBalls<N>* blocks, std::size_t count,
                                     const TreeColumns& tables, double h, bool balance, bool first,
                                     bool leaves) {
    using T = Number<double, N>;
    for (std::size_t i = 0; i < count; ++i) {
        TreeBalls<N>& balls = blocks[i];
        place_impulse<N>(balls, tables, h);
        const Vector3<T> acting = load_vector(balls.acting);
        TreeShare<T> whole = leaves ? TreeShare<T>::none() : read_share<N>(balls.node, tables);
        add_body<T>(
            whole, load(balls.mass), load_symmetric<N>(balls.inertia),
            angular_stiffness<T>(acting, load_vector(balls.impulse), load(balls.share) * T(h)),
            load_velocity<N>(balls.own), balance);
        const BallElimination<T> e = eliminate_ball<T>(whole.block, acting);
        keep_elimination<N>(balls, e);
        add_to_parents<N>(balls, e, tables, h, first);
    }
}

// ---- substitute

template <int N>
[[gnu::flatten]] void substitute_tree(TreeBalls<N>* blocks, std::size_t count,
                                      const TreeColumns& tables, double h, bool balance) {
    using T = Number<double, N>;
    for (std::size_t i = 0; i < count; ++i) {
        TreeBalls<N>& balls = blocks[i];
        const Velocity<T> parent = read_velocity<N>(ItemGroup<N>(balls.parent), tables.step);
        const Vector3<T> point = velocity_at<T>(parent, load_vector(balls.other_acting)) -
                                 load_vector(balls.gap) * T(1 / h);
        const BallElimination<T> e = kept_elimination<N>(balls);
        Velocity<T> step = substitute_ball<T>(e, load_vector(balls.acting), point);
        const Vector3<T> impulse = e.mass * point - e.free;
        const T active = load(balls.active);
        for (int k = 0; k < 3; ++k) {
            const T before = load(balls.impulse[k]), kept = balance ? T(0) : before;
            store(balls.impulse[k], select_greater(active, T(0), kept + impulse[k], before));
            step.v[k] = select_greater(active, T(0), step.v[k], T(0));
            step.w[k] = select_greater(active, T(0), step.w[k], T(0));
        }
        const Velocity<T> own = load_velocity<N>(balls.own);
        store_velocity<N>(balls.own, {own.v + step.v, own.w + step.w});
        write_velocity<N>(ItemGroup<N>(balls.node), tables.step, step);
    }
}

template <int W>
constexpr TreeKernels<W> all_tree_kernels() {
    constexpr int n = kBodyLanes<W>;
    return {begin_tree<n>, evaluate_tree<n>, eliminate_tree<n>, substitute_tree<n>};
}

}  // namespace plumb::kernels
