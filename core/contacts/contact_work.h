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
#include <cmath>

namespace plumb {

/// Sums over the contacts of an island [J].
struct ContactWork {
    double at_start = 0;   ///< λ u, and λ (u − w) of bounces and anchors
    double of_change = 0;  ///< λ Δu / 2, never negative
    double granted = 0;    ///< λ p, of overlap that is pushed out

    /// The greatest share s of all impulses, at most 1, that adds no more energy than is granted,
    /// and no more than `most` [J] in all: velocities change in proportion, and energy by s
    /// at_start + s² of_change.
    double share(double most) const {
        if (!(of_change > 0)) return 1;
        const double enough = (granted - at_start) / of_change;
        const double root = std::sqrt(at_start * at_start + 4 * of_change * most);
        return std::clamp(std::min(enough, (root - at_start) / (2 * of_change)), 0.0, 1.0);
    }
};

/// p, of a contact whose surfaces part at u and shall part at w, at least 0 [m/s].
inline double granted_speed(double u, double w) { return u < w ? std::max(0.0, (u + w) / 2) : w; }

/// What is no faster rests, and may come to rest as it likes [m/s]: iterations that have not
/// converged carry it up and down by as much. h: of the substep [s].
inline double resting_speed(const Settings& settings, double h) {
    return std::max(collision_threshold(settings), 2 * h * settings.gravity.norm());
}

/// The greatest share of a change, at most 1, with which a velocity is no more than `most` [m/s].
/// `before`: without it, less than that.
inline double share_within(double most, const Vector3d& before, const Vector3d& change) {
    const double a = change.squaredNorm(), b = before.dot(change),
                 c = before.squaredNorm() - most * most;
    if (!(a + 2 * b + c > 0)) return 1;
    return std::clamp((-b + std::sqrt(b * b - a * c)) / a, 0.0, 1.0);
}

/// The greatest share of changes of velocity, at most 1, with which no body is flung out: what
/// overlaps deeply, wedged between surfaces that are all but parallel, would leave many times as
/// fast as these part. Nothing becomes faster than so many times the speed of recovery, unless
/// something was as fast before. `each(visit)` calls visit(velocity, change) for each body [m/s].
template <class Each>
double share_without_flinging(const Settings& settings, Each each) {
    constexpr double kFlung = 4, kAsFast = 1e-6;
    double most = kFlung * settings.recovery_speed, share = 1;
    each([&](const Vector3d& before, const Vector3d&) {
        most = std::max(most, (1 + kAsFast) * before.norm());
    });
    each([&](const Vector3d& before, const Vector3d& change) {
        share = std::min(share, share_within(most, before, change));
    });
    return share;
}

}  // namespace plumb
