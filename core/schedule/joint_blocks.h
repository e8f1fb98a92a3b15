// SPDX-License-Identifier: MIT
/// Memory of the joints' solver: W joints side by side.
#pragma once

#include "schedule/contact_rows.h"

namespace plumb {

/// The two bodies of W rows or blocks of rows.
template <class Real, int W>
struct alignas(64) JointBodies {
    Real inverse_mass_a[W], inverse_mass_b[W];              // [1/kg]
    Real inverse_inertia_a[6][W], inverse_inertia_b[6][W];  // xx yy zz xy xz yz, world frame
    std::int32_t row_a[W], row_b[W];                        // row of the body in the velocity table
};

/// Ball joints, the quickest of all: one common point.
template <class Real, int W>
struct BallBlock : JointBodies<Real, W> {
    Real arm_a[3][W], arm_b[3][W];  // at the start of the substep [m]
    Real gap[3][W];                 // a − b at the start of the substep [m]
    Real share_a[W], share_b[W], lag_a[3][W], lag_b[3][W];  // JointLever [rad]
    Real impulse[3][W];                                     // on a, summed over the substep [N s]
    Real used[W];  // 1 where a joint sits, 0 in an empty lane
};

/// Where the points of a BallBlock are on its bodies.
template <int W>
struct alignas(64) BallFrames {
    double point_a[3][W], point_b[3][W];  // body frames, or the world's [m]
    double load[W];                       // impulse of the substeps before [N s]
    double used[W], held[W];              // 1 where a joint sits; 1 where b is the world
    std::uint32_t body_a[W], body_b[W];   // where there is none, any other of the block's
};

/// Joints of any kind.
template <class Real, int W>
struct JointBlock : JointBodies<Real, W> {
    Real arm_a[3][W], arm_b[3][W], apart[3][W];             // at the start of the substep [m]
    Real e[3][3][W], u[3][3][W], w[3][3][W];                // [row][component]
    Real share_a[W], share_b[W], lag_a[3][W], lag_b[3][W];  // JointLever [rad]
    Real line_share[W], line_lag[3][W];                     // of a distance joint's line [m]
    Real lock[6][W], softness[6][W], lag[6][W], length[W];
    Real lambda[6][W];  // summed over the substep [N s], [N m s]
};

/// One row along or about a free axis.
template <class Real, int W>
struct DriveBlock : JointBodies<Real, W> {
    Real along[3][W], turn_a[3][W], turn_b[3][W];
    Real bias[W], softness[W], mass[W];  // mass: 1 / (K + softness)
    Real lowest[W], highest[W];
    Real lambda[W];
};

}  // namespace plumb
