// SPDX-License-Identifier: MIT
/// How fast surfaces approach, when that is a collision (§6, after Mirtich), and how large bodies
/// are.
#pragma once

#include "world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plumb {

/// Velocity of the contact's point on a against that on b [m/s]. `point`: where it acts now [m];
/// velocity, angular_velocity: [body].
inline Vector3d relative_velocity(const Bodies& b, const std::vector<Vector3d>& velocity,
                                  const std::vector<Vector3d>& angular_velocity, const Contact& c,
                                  const Vector3d& point) {
    const auto velocity_at = [&](std::uint32_t i) -> Vector3d {
        return velocity[i] + angular_velocity[i].cross(point - b.position[i]);
    };
    return velocity_at(c.a) - velocity_at(c.b);
}

/// The same along the normal, without the forces of the substep; negative: they approach.
inline double separating_velocity(const Bodies& b, const Contact& c, const Vector3d& point) {
    return to_eigen(c.normal).dot(
        relative_velocity(b, b.velocity_now, b.angular_velocity_now, c, point));
}

/// A gap that nothing closes within a substep [m].
inline constexpr double kOutOfReach = 1e6;

/// Gap that a contact keeps its surfaces from closing [m].
inline double gap_in_substep(const ContactTable& c, std::size_t i) {
    return c.is_passing(i) ? kOutOfReach : c.gap[i];
}

/// Separating speed that restitution asks of a contact [m/s]; 0: none.
inline double restitution_velocity_of(const ContactTable& c, std::size_t i) {
    return c.restitution_velocity.empty() ? 0 : c.restitution_velocity[i];
}

/// Bounding radius of the smaller of the bodies that can move [m].
inline double smaller_radius(const Bodies& b, const Contact& c) {
    double radius = std::numeric_limits<double>::infinity();
    for (const std::uint32_t body : {c.a, c.b})
        if (b.motion[body] == Motion::dynamic) radius = std::min(radius, b.bounding_radius[body]);
    return radius;
}

/// A pair that approaches faster collides: √(2 g ε) [m/s].
inline double collision_threshold(const Settings& s) {
    return std::sqrt(2 * s.gravity.norm() * s.collision_depth);
}

}  // namespace plumb
