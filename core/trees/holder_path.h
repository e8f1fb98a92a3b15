// SPDX-License-Identifier: MIT
/// The way of a kinematic body within a substep, for what hangs by it and divides that substep.
///
/// A script is followed from substep to substep, in each at one velocity. In parts of a substep
/// that would be a jolt to each start of one: as steady a beat as there is, and light rods under a
/// load have swings that keep time with it. The way is therefore a cubic, which begins and ends at
/// the mean velocities of the substeps that meet there; where the substep ends it is where the
/// script is. Where the velocity jumps, as where one straight way of a script ends and another
/// begins, so does that of the cubic, for nothing is to feel a jump before it comes. What has no
/// script keeps the velocity that it was given.
#pragma once

#include "constraints/connector.h"
#include "effects/plan.h"
#include "world/world.h"

#include <array>

namespace plumb {

class HolderPath {
public:
    /// Of nothing, which stands still.
    HolderPath() = default;
    /// When velocities are those of the substep of length h [s] that begins, and poses are still
    /// those at its start.
    HolderPath(const World& world, const Plan& plan, std::uint32_t body, double h);

    /// Whether it is anywhere else in this substep, or was or will be in those beside it.
    bool moves() const { return moves_; }

    /// At a time since the substep began, which is in it or in the one before [s].
    Placement at(double time) const;
    /// At which it comes from one place to the other.
    Velocity<double> velocity(double from, double to) const;

private:
    /// One way through a substep: the velocity at its start, its mean, and that at its end.
    struct Curve {
        Vector3d start = Vector3d::Zero(), mean = Vector3d::Zero(), end = Vector3d::Zero();

        bool is_still() const { return start.isZero(0) && mean.isZero(0) && end.isZero(0); }
        /// By the share s of the substep, over its length.
        Vector3d way(double s) const {
            return s * (start + s * ((3 * mean - 2 * start - end) + s * (start + end - 2 * mean)));
        }
    };
    /// Of the substep before, and of this one.
    struct Ways {
        Curve before, now;

        bool are_still() const { return before.is_still() && now.is_still(); }
        Vector3d at(double s) const { return s < 0 ? before.way(s + 1) - before.mean : now.way(s); }
    };

    /// From the velocities of the substeps from the third before this one to the second after it.
    static Ways ways_of(const std::array<Vector3d, 6>& velocities);

    bool moves_ = false;
    double h_ = 0;
    Placement start_;
    Ways ways_, turns_;  ///< [m/s], [rad/s]
};

}  // namespace plumb
