// SPDX-License-Identifier: MIT
/// The loops behind the joints' kernels. Included by the units of each instruction set, through
/// kernels/joint_tables.h, and by nothing else.
#pragma once

#include "constraints/drive.h"
#include "constraints/joint_rows.h"
#include "constraints/point.h"
#include "kernels/gather.h"
#include "kernels/joint_begin.h"
#include "kernels/joint_kernels.h"

namespace plumb::kernels {

template <class Real, int W>
struct JoinedBodies {
    using T = Number<Real, W>;
    Velocity<T> a, b;              ///< changes since the start of the substep
    Velocity<T> total_a, total_b;  ///< whole velocities
    InverseMass<T> mass_a, mass_b;
};

template <class T>
inline Velocity<T> sum(const Velocity<T>& x, const Velocity<T>& y) {
    return {x.v + y.v, x.w + y.w};
}

template <class Real, int W>
inline JoinedBodies<Real, W> read_joined(const JointBodies<Real, W>& block,
                                         const BodyRows<Real>& bodies) {
    using T = Number<Real, W>;
    auto symmetric = [](const Real(&m)[6][W]) {
        return Symmetric3<T>{load(m[0]), load(m[1]), load(m[2]),
                             load(m[3]), load(m[4]), load(m[5])};
    };
    JoinedBodies<Real, W> j;
    j.a = read_velocities<Real, W>(bodies.change, block.row_a);
    j.b = read_velocities<Real, W>(bodies.change, block.row_b);
    j.total_a = sum(j.a, read_velocities<Real, W>(bodies.start, block.row_a));
    j.total_b = sum(j.b, read_velocities<Real, W>(bodies.start, block.row_b));
    j.mass_a = {load(block.inverse_mass_a), symmetric(block.inverse_inertia_a)};
    j.mass_b = {load(block.inverse_mass_b), symmetric(block.inverse_inertia_b)};
    return j;
}

template <class Real, int W>
inline void write_joined(const JointBodies<Real, W>& block, const BodyRows<Real>& bodies,
                         const JoinedBodies<Real, W>& j) {
    write_velocities<Real, W>(bodies.change, block.row_a, bodies.dynamic_count, j.a);
    write_velocities<Real, W>(bodies.change, block.row_b, bodies.dynamic_count, j.b);
}

/// Calls visit(block, bodies) for blocks [first, last) and writes the bodies back.
template <class Real, int W, class Block, class Visit>
inline void each_block(Block* blocks, const BodyRows<Real>& bodies, std::uint32_t first,
                       std::uint32_t last, Visit visit) {
    for (std::uint32_t i = first; i < last; ++i) {
        JoinedBodies<Real, W> joined = read_joined<Real, W>(blocks[i], bodies);
        visit(blocks[i], joined);
        write_joined<Real, W>(blocks[i], bodies, joined);
    }
}

// ---- ball joints

/// One iteration of a block; returns the impulses on a [N s].
template <class Real, int W, class T = Number<Real, W>>
inline Vector3<T> join_balls(const BallBlock<Real, W>& block, JoinedBodies<Real, W>& j,
                             const T& h) {
    // an empty lane, or a joint that an exact island has, has unit mass, so that its 3 × 3 system
    // can be solved, and neither gap nor velocity, so that it gives no impulse
    const T used = load(block.used);
    j.mass_a.mass = j.mass_a.mass + (T(1) - used);
    j.total_a = {j.total_a.v * used, j.total_a.w * used};
    j.total_b = {j.total_b.v * used, j.total_b.w * used};
    return join<T>(j.a, j.b, j.total_a, j.total_b, j.mass_a, j.mass_b, load_vector(block.arm_a),
                   load_vector(block.arm_b), load_vector(block.gap),
                   {load(block.share_a), load_vector(block.lag_a)},
                   {load(block.share_b), load_vector(block.lag_b)}, h);
}

template <class Real, int W>
[[gnu::flatten]] void solve_balls(BallBlock<Real, W>* blocks, const BodyRows<Real>& bodies, Real h,
                                  std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    each_block<Real, W>(blocks, bodies, first, last, [h](auto& block, auto& j) {
        const Vector3<T> impulse = join_balls(block, j, T(h));
        store_vector(block.impulse, Vector3<T>(load_vector(block.impulse) + impulse));
    });
}

// ---- joints of any kind

template <class Real, int W, class T = Number<Real, W>>
inline JointGeometry<T> load_geometry(const JointBlock<Real, W>& block) {
    JointGeometry<T> g;
    g.r_a = load_vector(block.arm_a), g.r_b = load_vector(block.arm_b);
    g.apart = load_vector(block.apart);
    for (int k = 0; k < 3; ++k) {
        g.e[k] = load_vector(block.e[k]);
        g.u[k] = load_vector(block.u[k]);
        g.w[k] = load_vector(block.w[k]);
    }
    for (int k = 0; k < 6; ++k) {
        g.lock[k] = load(block.lock[k]);
        g.softness[k] = load(block.softness[k]), g.lag[k] = load(block.lag[k]);
    }
    g.lever_a = {load(block.share_a), load_vector(block.lag_a)};
    g.lever_b = {load(block.share_b), load_vector(block.lag_b)};
    g.line_share = load(block.line_share), g.line_lag = load_vector(block.line_lag);
    g.length = load(block.length);
    return g;
}

template <class Real, int W>
[[gnu::flatten]] void solve_joints(JointBlock<Real, W>* blocks, const BodyRows<Real>& bodies,
                                   Real h, std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    each_block<Real, W>(blocks, bodies, first, last, [h](auto& block, auto& j) {
        T lambda[6];
        for (int k = 0; k < 6; ++k) lambda[k] = load(block.lambda[k]);
        solve_joint<T>(j.a, j.b, j.total_a, j.total_b, j.mass_a, j.mass_b, load_geometry(block),
                       lambda, T(h));
        for (int k = 0; k < 6; ++k) store(block.lambda[k], lambda[k]);
    });
}

// ---- drives

template <class Real, int W, class T = Number<Real, W>>
inline void push_drive(const DriveBlock<Real, W>& block, JoinedBodies<Real, W>& j,
                       const T& impulse) {
    const Vector3<T> along = load_vector(block.along);
    j.a.v += along * (impulse * j.mass_a.mass);
    j.b.v -= along * (impulse * j.mass_b.mass);
    j.a.w += j.mass_a.inertia * Vector3<T>(load_vector(block.turn_a) * impulse);
    j.b.w -= j.mass_b.inertia * Vector3<T>(load_vector(block.turn_b) * impulse);
}

/// How fast a driven axis moves or turns [m/s], [rad/s].
template <class Real, int W, class T = Number<Real, W>>
inline T drive_rate(const DriveBlock<Real, W>& block, const JoinedBodies<Real, W>& j) {
    return dot(load_vector(block.along), Vector3<T>(j.total_a.v - j.total_b.v)) +
           (dot(load_vector(block.turn_a), j.total_a.w) -
            dot(load_vector(block.turn_b), j.total_b.w));
}

template <class Real, int W>
[[gnu::flatten]] void solve_drives(DriveBlock<Real, W>* blocks, const BodyRows<Real>& bodies, Real,
                                   std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    each_block<Real, W>(blocks, bodies, first, last, [](auto& block, auto& j) {
        T lambda = load(block.lambda);
        const T impulse =
            drive<T>(lambda, drive_rate(block, j), load(block.bias), load(block.softness),
                     load(block.mass), load(block.lowest), load(block.highest));
        store(block.lambda, lambda);
        push_drive(block, j, impulse);
    });
}

}  // namespace plumb::kernels
