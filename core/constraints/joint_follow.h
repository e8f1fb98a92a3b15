// SPDX-License-Identifier: MIT
/// Whether a joint's impulse acts where the joint was at the start of a substep or goes along with
/// its body's turn.
///
/// At the start (0) is what keeps momentum to rounding and energy to second order, as SHAKE does:
/// both bodies feel the impulse at one point of the start's poses. But a load P/h on an arm r turns
/// a body like a pendulum of ω² = |P| |r| / (h I), and a force that stays where it was is an
/// explicit step of that pendulum: stable for h ω < 2 only. At the end (1) it is an implicit step,
/// which bears any load and loses some energy and angular momentum: the two bodies then feel the
/// impulse at points a little apart.
#pragma once

#include "math/lanes.h"
#include "math/symmetric.h"

namespace plumb {

/// From 0 to 1. `impulse`: of the substep before [N s]; `moment`: of its rotational rows [N m s];
/// `inverse_inertia`: world frame [1/(kg m²)]; `turn`: of the body in this substep [rad], for rows
/// that stay where they were are also poor rows of a body that turns far.
template <class T>
inline T joint_follow(const T& impulse, const T& moment, const T& arm,
                      const Symmetric3<T>& inverse_inertia, const T& turn, const T& h) {
    const T softest = inverse_inertia.xx + inverse_inertia.yy + inverse_inertia.zz;
    const T load = h * (impulse * arm + moment) * softest;  // (h ω)²
    const T wanted = max((load - T(0.05)) * T(4), (turn - T(0.25)) * T(4));
    return min(max(wanted, T(0)), T(1));
}

}  // namespace plumb
