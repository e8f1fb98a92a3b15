// SPDX-License-Identifier: MIT
/// Whether a joint's impulse acts where the joint was at the start of a substep or goes along with
/// its body's turn.
///
/// At the start (0) is what keeps momentum to rounding and energy to second order, as SHAKE does:
/// both bodies feel the impulse at one point of the start's poses. But a load P/h on an arm r turns
/// a body like a pendulum of ω² = |P| |r| / (h I), and a force that stays where it was is an
/// explicit step of that pendulum: stable for h ω < 2 only. At the end (1) it is an implicit step,
/// which bears any load and loses some energy.
#pragma once

#include "math/symmetric.h"

#include <algorithm>

namespace plumb {

/// From 0 to 1. `impulse`: of the substep before [N s]; `moment`: of its rotational rows [N m s];
/// `inverse_inertia`: world frame [1/(kg m²)]; `turn`: of the body in this substep [rad], for rows
/// that stay where they were are also poor rows of a body that turns far.
inline double joint_follow(double impulse, double moment, double arm,
                           const Symmetric3<double>& inverse_inertia, double turn, double h) {
    const double softest = inverse_inertia.xx + inverse_inertia.yy + inverse_inertia.zz;
    const double load = h * (impulse * arm + moment) * softest;  // (h ω)²
    return std::clamp(std::max(4 * (load - 0.05), 4 * (turn - 0.25)), 0.0, 1.0);
}

}  // namespace plumb
