// SPDX-License-Identifier: MIT
/// How far bodies have come since the detection before: what bounds how far pairs have come against
/// each other, without a look at their poses.
#pragma once

#include <plumb/contact_set.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

struct PoseChange {
    static constexpr double kUnknown = std::numeric_limits<double>::infinity();

    double travel = kUnknown;  ///< of the centre of mass [m]
    double turn = kUnknown;    ///< no point at distance r of it has turned further than r times it

    /// From one pose to another. Turns are measured by the distance of their unit quaternions,
    /// 2 sin(θ/4), for which the triangle inequality holds; the chord 2 sin(θ/2) is at most twice
    /// that.
    static PoseChange between(const Pose& from, const Pose& to) {
        const double x = to.position.x - from.position.x, y = to.position.y - from.position.y,
                     z = to.position.z - from.position.z;
        const auto apart = [&](double sign) {
            const double qx = to.rotation.x - sign * from.rotation.x,
                         qy = to.rotation.y - sign * from.rotation.y,
                         qz = to.rotation.z - sign * from.rotation.z,
                         qw = to.rotation.w - sign * from.rotation.w;
            return qx * qx + qy * qy + qz * qz + qw * qw;
        };
        return {std::sqrt(x * x + y * y + z * z), 2 * std::sqrt(std::min(apart(1), apart(-1)))};
    }
};

}  // namespace plumb
