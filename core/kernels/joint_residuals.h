// SPDX-License-Identifier: MIT
/// The loops that find the residuals of joints (effects/residual.h) at the velocities that
/// iterations have left. Included by the units of each instruction set and by nothing else.
///
/// Turns count by the length ℓ that makes the bodies' inertia of their mass: torques over ℓ are
/// forces, and angles times ℓ lengths.
#pragma once

#include "kernels/inverse.h"
#include "kernels/joint_passes.h"

#include <utility>

namespace plumb::kernels {

/// Calls visit(block, bodies), which returns (impulse², velocity²), for blocks [first, last).
template <class Real, int W, class Block, class Visit>
inline void each_residual(PairResidual<Real, W>* residuals, const Block* blocks,
                          const BodyRows<Real>& bodies, std::uint32_t first, std::uint32_t last,
                          Visit visit) {
    using T = Number<Real, W>;
    for (std::uint32_t i = first; i < last; ++i) {
        JoinedBodies<Real, W> joined = read_joined<Real, W>(blocks[i], bodies);
        const auto [impulse, error] = visit(blocks[i], joined);
        store(residuals[i].worst, impulse), store(residuals[i].sum, impulse);
        store(residuals[i].error, error), store(residuals[i].push, T(0));
    }
}

template <class Real, int W>
[[gnu::flatten]] void find_ball_residuals(PairResidual<Real, W>* residuals,
                                          const BallBlock<Real, W>* blocks,
                                          const BodyRows<Real>& bodies, Real h, std::uint32_t first,
                                          std::uint32_t last) {
    using T = Number<Real, W>;
    each_residual<Real, W>(residuals, blocks, bodies, first, last, [h](auto& block, auto& j) {
        const Velocity<T> a = j.a, b = j.b;
        const Vector3<T> impulse = join_balls<Real, W>(block, j, T(h));
        const auto change = [](const Velocity<T>& now, const Velocity<T>& before, const auto& arm) {
            return velocity_at<T>({now.v - before.v, now.w - before.w}, load_vector(arm));
        };
        const Vector3<T> parted = change(j.a, a, block.arm_a) - change(j.b, b, block.arm_b);
        return std::pair(dot(impulse, impulse), dot(parted, parted));
    });
}

/// ℓ² of two bodies [m²].
template <class Real, int W, class T = Number<Real, W>>
inline T squared_length(const JoinedBodies<Real, W>& j) {
    const Symmetric3<T>&a = j.mass_a.inertia, &b = j.mass_b.inertia;
    const T turns = (a.xx + a.yy + a.zz) + (b.xx + b.yy + b.zz);
    return T(3) * (j.mass_a.mass + j.mass_b.mass) * inverse_or_zero<T>(turns);
}

template <class Real, int W>
[[gnu::flatten]] void find_joint_residuals(PairResidual<Real, W>* residuals,
                                           const JointBlock<Real, W>* blocks,
                                           const BodyRows<Real>& bodies, Real h,
                                           std::uint32_t first, std::uint32_t last) {
    using T = Number<Real, W>;
    each_residual<Real, W>(residuals, blocks, bodies, first, last, [h](auto& block, auto& j) {
        const JointGeometry<T> geometry = load_geometry(block);
        const JointRows<T> rows = joint_rows<T>(geometry, j.total_a, j.total_b, T(h));
        T k[6][6], push[6], lack[2], given[2];
        joint_response<T>(k, rows, geometry, j.mass_a, j.mass_b);
        lack[0] = lack[1] = given[0] = given[1] = T(0);
        for (int i = 0; i < 6; ++i) {
            push[i] = (rows.c[i] / T(h) + geometry.softness[i] * load(block.lambda[i])) *
                      geometry.lock[i];
            lack[i / 3] += push[i] * push[i];
        }
        solve_ldlt<T, 6>(k, push);
        for (int i = 0; i < 6; ++i) given[i / 3] += push[i] * push[i];
        const T length = squared_length<Real, W>(j);
        return std::pair(T(given[0] + given[1] * inverse_or_zero<T>(length)),
                         T(lack[0] + lack[1] * length));
    });
}

template <class Real, int W>
[[gnu::flatten]] void find_drive_residuals(PairResidual<Real, W>* residuals,
                                           const DriveBlock<Real, W>* blocks,
                                           const BodyRows<Real>& bodies, Real, std::uint32_t first,
                                           std::uint32_t last) {
    using T = Number<Real, W>;
    each_residual<Real, W>(residuals, blocks, bodies, first, last, [](auto& block, auto& j) {
        T lambda = load(block.lambda);
        const T impulse =
            drive<T>(lambda, drive_rate(block, j), load(block.bias), load(block.softness),
                     load(block.mass), load(block.lowest), load(block.highest));
        const T speed = impulse * inverse_or_zero<T>(load(block.mass));
        const Vector3<T> along = load_vector(block.along);
        const T length = select_greater(dot(along, along), T(0), T(1),
                                        T((j.mass_a.mass + j.mass_b.mass) * load(block.mass)));
        return std::pair(T(impulse * impulse * inverse_or_zero<T>(length)),
                         T(speed * speed * length));
    });
}

}  // namespace plumb::kernels
