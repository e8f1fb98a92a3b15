// SPDX-License-Identifier: MIT
#include "contacts/still_ground.h"

#include "world/body_momentum.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

enum Touch : std::uint8_t { nothing, fixed_only, else_too };

/// Gains below this share of what moved are rounding.
constexpr double kRounding = 1e-12;

/// Share of its kinetic energy by which a body may be above what it had, for as long as the sum
/// half a substep back is not: small swings are left alone, and cannot add up.
constexpr double kSlack = 8e-4;

/// The larger of both sums, less the potential energy [J]; swing: ½ h F·v.
double larger_sum(double kinetic, double swing) {
    return kinetic + std::max(swing, -kSlack * kinetic);
}

/// Gravity and the constant force [N].
Vector3d force_on(const World& world, std::uint32_t i) {
    return world.bodies.mass[i] * world.settings.gravity + world.bodies.force[i];
}

}  // namespace

void StillGround::note(const World& world, double h) {
    const Bodies& b = world.bodies;
    const ContactTable& c = world.contacts;
    touches_.assign(b.size(), nothing);
    had_.clear();
    const auto meet = [&](std::uint32_t body, std::uint32_t other, bool bounces) {
        const bool still = b.motion[other] == Motion::fixed && !bounces;
        if (!still || touches_[body] == nothing) touches_[body] = still ? fixed_only : else_too;
    };
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const bool bounces = !c.restitution.empty() && c.restitution[i] != Restitution::none;
        meet(c.found[i].a, c.found[i].b, bounces);
        meet(c.found[i].b, c.found[i].a, bounces);
    }
    for (const Joint& joint : world.joints.joints)
        for (const std::uint32_t body : {joint.a, joint.b})
            if (body != kNoIndex) touches_[body] = else_too;
    world.each_body_among_particles([&](std::uint32_t body) { touches_[body] = else_too; });
    for (std::uint32_t i = 0; i < b.size(); ++i) {
        if (touches_[i] != fixed_only || b.motion[i] != Motion::dynamic) continue;
        const double swing = 0.5 * h * force_on(world, i).dot(b.velocity[i]);
        had_.push_back({i, larger_sum(kinetic_energy(b, i), swing), b.position[i]});
    }
}

void StillGround::take_back(World& world, double h) const {
    Bodies& b = world.bodies;
    for (const Had& had : had_) {
        const std::uint32_t i = had.body;
        const double kinetic = kinetic_energy(b, i);
        if (kinetic == 0) continue;
        const Vector3d force = force_on(world, i);
        const double fallen = force.dot(b.position[i] - had.position),
                     given = h * b.torque[i].dot(b.angular_velocity[i]),
                     swing = 0.5 * h * force.dot(b.velocity[i]);
        const double gained = larger_sum(kinetic, swing) - had.energy - fallen - given;
        if (gained <= kRounding * (kinetic + std::abs(fallen))) continue;
        const double kept = std::sqrt(std::max(0.0, 1 - gained / kinetic));
        b.velocity[i] *= kept;
        b.angular_velocity[i] *= kept;
    }
}

}  // namespace plumb
