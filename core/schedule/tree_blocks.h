// SPDX-License-Identifier: MIT
/// Memory of the trees' solver: what the bodies of a tree hand to each other, and N balls side by
/// side.
#pragma once

#include "constraints/tree_block.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plumb {

/// Row sizes of TreeTables.
inline constexpr int kTreeTurn = 4;      ///< x y z w
inline constexpr int kTreeVelocity = 8;  ///< v 3, free, ω 3, free

/// Tables by node, with two rows more: the ground, to which all may add since none reads what they
/// added, and that of idle lanes, to which none adds.
struct TreeTables {
    std::vector<double> turn, velocity;  ///< over the substep, at the preview
    std::vector<double> share;           ///< TreeShare: what the children add to a body
    std::vector<double> step;            ///< Δv of a Newton step, as a velocity
    std::uint32_t ground, idle;

    explicit TreeTables(std::size_t nodes)
        : turn((nodes + 2) * kTreeTurn, 0),
          velocity((nodes + 2) * kTreeVelocity, 0),
          share((nodes + 2) * kShareNumbers, 0),
          step((nodes + 2) * kTreeVelocity, 0),
          ground(static_cast<std::uint32_t>(nodes)),
          idle(static_cast<std::uint32_t>(nodes) + 1) {
        for (std::size_t i = kTreeTurn - 1; i < turn.size(); i += kTreeTurn) turn[i] = 1;
    }
};

/// The same as plain numbers, for the kernels.
struct TreeColumns {
    double *turn, *velocity, *share, *step;
};

/// N bodies at one depth of the trees, no two of them of one parent, and the balls that they hang
/// by. What is named without a body is the child's.
template <int N>
struct alignas(64) TreeBalls {
    // fixed
    std::uint32_t node[N], parent[N];  // in TreeTables
    std::uint32_t body[N], other[N];   // in Bodies; where there is no other, the body again
    std::int32_t row[N];               // in the velocity table
    alignas(64) double point[3][N];    // of the joint, body frames or the world's [m]
    double other_point[3][N];
    double used[N], held[N];  // 1 where a body sits; 1 where it hangs from the world
    double active[N];         // 1 where the tree is still to be solved
    double hung[N];           // 1 where its root hangs by something
    double load[N];           // impulse of the substeps before [N s]
    double sign[N];           // 1 where the body is the joint's a, else −1
    double meet[N];           // 1 where the arms of an impulse meet in one point, else 0
    // at the start of a substep
    double mass[N], inertia[6][N];                   // world frame [kg], [kg m²]
    double arm[3][N], other_arm[3][N], apart[3][N];  // child's point − parent's [m]
    double share[N], other_share[N];                 // JointLever
    double lag[3][N], other_lag[3][N];               // likewise [rad]
    double shift[3][N];     // of a point on an immovable parent, over the substep [m]
    double deferred[3][N];  // part of `apart` that is left for later [m]
    double start[6][N];     // velocity with forces and what others changed of it
    double own[6][N];       // change by this solver
    // at the preview
    double gap[3][N];                         // child's point − parent's, without `deferred` [m]
    double violation[N];                      // its greatest component [m]
    double acting[3][N], other_acting[3][N];  // arms by which the impulse acts [m]
    double impulse[3][N];                     // on the child [N s]
    // eliminated, as in BallElimination
    double articulated[6][N], free[3][N], across[9][N], turn[6][N], torque[3][N];
    // what others changed of the velocity, a part of `start`; and the sum with `own` when that was
    // handed on
    double given[6][N], written[6][N];
};

}  // namespace plumb
