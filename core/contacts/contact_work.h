// SPDX-License-Identifier: MIT
/// The work that contacts' impulses do in a substep, and what they may.
///
/// An impulse λ that changes the velocity at a contact from u to u + Δu does the work λ (u + Δu/2).
/// What pushes and rubs loses energy by it, but for what the substep asks for: a speed w at which
/// old overlap is pushed out, a collision bounces or anchors pull back. On the way from u to w that
/// adds λ p, with p = (u + w)/2 where that is positive. Iterations that are not finished may add
/// more: a heavy body that has come down on light ones is still carried by what stopped it, and
/// thrown back.
#pragma once

#include "contacts/contact_measures.h"

#include <algorithm>

namespace plumb {

/// Sums over contacts [J].
struct ContactWork {
    double beyond = 0;     ///< λ (u − p)
    double of_change = 0;  ///< λ Δu / 2, never negative over all contacts of an island

    /// The greatest share of all impulses, at most 1, that adds no more energy than is asked for:
    /// velocities change in proportion.
    double share() const {
        if (!(beyond + of_change > 0) || !(of_change > 0)) return 1;
        return std::clamp(-beyond / of_change, 0.0, 1.0);
    }
};

/// p, of a contact whose surfaces part at u and shall part at w, at least 0 [m/s].
inline double granted_speed(double u, double w) { return u < w ? std::max(0.0, (u + w) / 2) : w; }

/// What is no faster rests, and may come to rest as it likes [m/s]: iterations that have not
/// converged carry it up and down by as much. h: of the substep [s].
inline double resting_speed(const Settings& settings, double h) {
    return std::max(collision_threshold(settings), 2 * h * settings.gravity.norm());
}

}  // namespace plumb
