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

/// The same by the velocities of now, which have the forces in them.
inline Vector3d relative_velocity(const World& world, std::size_t contact) {
    const Bodies& b = world.bodies;
    return relative_velocity(b, b.velocity, b.angular_velocity, world.contacts.found[contact],
                             world.contacts.point[contact]);
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

/// Bounding radius of the smaller of the bodies that can move [m].
inline double smaller_radius(const Bodies& b, const Contact& c) {
    double radius = std::numeric_limits<double>::infinity();
    for (const std::uint32_t body : {c.a, c.b})
        if (b.motion[body] == Motion::dynamic) radius = std::min(radius, b.bounding_radius[body]);
    return radius;
}

/// Iterations converge well enough where masses are not so many times each other.
inline constexpr double kUneven = 5;

/// Whether one of two bodies is so much heavier than the other.
inline bool is_uneven(const Bodies& b, const Contact& c) {
    const double lighter = std::min(b.mass[c.a], b.mass[c.b]);
    return lighter > 0 && std::max(b.mass[c.a], b.mass[c.b]) > kUneven * lighter;
}

/// Share of Settings::recovery_speed at which a contact's overlap is pushed out at the most. Bodies
/// keep that speed when they part: in a crushed heap it adds up from layer to layer, and what is
/// thrown comes down askew and is wedged. So gravity takes it back within a small share of their
/// size.
inline double share_of_recovery(const World& world, const Contact& c) {
    constexpr double kThrown = 0.04;  // height, in radii
    constexpr double kUnhurried = 1;  // [radii/s], where there is hardly any gravity
    const double radius = smaller_radius(world.bodies, c);
    const double thrown = std::sqrt(2 * world.settings.gravity.norm() * kThrown * radius);
    return std::min(1.0, std::max(thrown, kUnhurried * radius) / world.settings.recovery_speed);
}

/// The same without overlap that is not to be pushed out in this substep: what is more than `most`
/// [m], which is pushed out at Settings::recovery_speed, or its like at the contact's own speed.
/// Overlap of bodies that pass each other so many times as fast as it is pushed out is made anew in
/// each step, and pushing it out would throw them to and fro ever faster where they are squeezed.
inline double gap_to_solve_for(const World& world, std::size_t i, double most) {
    constexpr double kPassing = 2, kNoticed = 0.1;
    const ContactTable& c = world.contacts;
    const Settings& s = world.settings;
    const double gap = gap_in_substep(c, i);
    if (-gap * s.substeps < kNoticed * s.recovery_speed * s.dt) return gap;
    const Bodies& b = world.bodies;
    const Vector3d u =
        relative_velocity(b, b.velocity_now, b.angular_velocity_now, c.found[i], c.point[i]);
    const double fast = kPassing * s.recovery_speed;
    if (u.squaredNorm() > fast * fast) return 0;
    return std::max(gap, -most * share_of_recovery(world, c.found[i]));
}

/// Whether a substep pushes out less of a contact's overlap than there is. `solved_for`: the gap to
/// solve for; most: as above [m].
inline bool is_clamped(double gap, double solved_for, double most) {
    return -gap > most || (solved_for < 0 && solved_for > gap);
}

/// Separating speed that restitution asks of a contact [m/s]; 0: none.
inline double restitution_velocity_of(const ContactTable& c, std::size_t i) {
    return c.restitution_velocity.empty() ? 0 : c.restitution_velocity[i];
}

/// Whether a contact's surfaces are apart, by more than rounding may make of such that touch.
inline bool is_open(const World& world, std::size_t i) {
    constexpr double kRounding = 1e-6;  // of the smaller body's radius
    const ContactTable& c = world.contacts;
    return c.gap[i] > kRounding * smaller_radius(world.bodies, c.found[i]);
}

/// What gravity moves a body by in a step, from rest and as the step counts it [m].
inline double fall_in_step(const Settings& s) { return s.gravity.norm() * s.dt * s.dt; }

/// How far the centre of a body may come within dt [s] at its velocity and by its own force [m].
inline double way_in(const Bodies& b, std::size_t i, double dt) {
    return b.velocity[i].norm() * dt + b.force[i].norm() * b.inverse_mass[i] * dt * dt;
}

/// A pair that approaches faster collides: √(2 g ε) [m/s].
inline double collision_threshold(const Settings& s) {
    return std::sqrt(2 * s.gravity.norm() * s.collision_depth);
}

}  // namespace plumb
