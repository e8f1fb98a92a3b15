// SPDX-License-Identifier: MIT
/// How fast surfaces approach, when that is a collision (§6, after Mirtich), and how large bodies
/// are.
#pragma once

#include "world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

/// Velocity of the contact's point on a against that on b, along the normal, without the forces of
/// the substep [m/s]; negative: they approach. `point`: where it acts now [m].
inline double separating_velocity(const Bodies& b, const Contact& c, const Vector3d& point) {
    const auto velocity = [&](std::uint32_t i) -> Vector3d {
        return b.velocity_now[i] + b.angular_velocity_now[i].cross(point - b.position[i]);
    };
    return to_eigen(c.normal).dot(velocity(c.a) - velocity(c.b));
}

/// Bounding radius of the smaller of the bodies that can move [m].
inline double smaller_radius(const Bodies& b, const Contact& c) {
    double radius = std::numeric_limits<double>::infinity();
    for (const std::uint32_t body : {c.a, c.b})
        if (b.motion[body] == Motion::dynamic) radius = std::min(radius, b.reach[body]);
    return radius;
}

/// A pair that approaches faster collides: √(2 g ε) [m/s].
inline double collision_threshold(const Settings& s) {
    return std::sqrt(2 * s.gravity.norm() * s.collision_depth);
}

}  // namespace plumb
