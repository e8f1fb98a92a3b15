// SPDX-License-Identifier: MIT
#include "contacts/still_ground.h"

#include "world/body_momentum.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Gains below this share of what moved are rounding.
constexpr double kEnergyRounding = 1e-12;

/// Share of its energy, as if it stood on its end, by which a body may be above what it had, for as
/// long as the sum half a substep back is not: small swings are left alone, and cannot add up.
constexpr double kSlack = 2.5e-4;

/// Share of its kinetic energy up to which a body may regain what it lost in no impact, and for how
/// long [s].
constexpr double kRegained = 0.01, kWhile = 2;

/// Gravity and the constant force [N].
Vector3d force_on(const World& world, std::uint32_t i) {
    return world.bodies.mass[i] * world.settings.gravity + world.bodies.force[i];
}

/// The larger of both sums, less the potential energy [J]; force [N].
double larger_sum(const Bodies& b, std::uint32_t i, const Vector3d& force, double h) {
    const double kinetic = kinetic_energy(b, i);
    const double most = kSlack * (kinetic + force.norm() * b.bounding_radius[i]);
    return kinetic + std::max(0.5 * h * force.dot(b.velocity[i]), -most);
}

/// What of a rise of energy [J] is more than what was lost before, which is brought up to date.
double beyond_lost(double& lost, double rise, double kinetic, double h) {
    const double beyond = rise - lost, most = kRegained * kinetic;
    if (rise > 0)
        lost = std::max(0.0, -beyond);
    else if (-rise > lost + most)
        lost = 0;  // an impact
    else
        lost = std::max(lost, std::min(lost - rise, most));
    lost *= std::max(0.0, 1 - h / kWhile);
    return beyond;
}

}  // namespace

void StillGround::note(const World& world, const GroundTouch& ground, double h) {
    const Bodies& b = world.bodies;
    had_.clear();
    for (std::uint32_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] != Motion::dynamic || !ground.is_alone(i)) continue;
        had_.push_back({i, larger_sum(b, i, force_on(world, i), h), b.position[i]});
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
                     given = h * b.torque[i].dot(b.angular_velocity[i]);
        const double rise = larger_sum(b, i, force, h) - had.energy - fallen - given;
        const double gained = beyond_lost(b.lost_to_ground[i], rise, kinetic, h);
        if (gained <= kEnergyRounding * (kinetic + std::abs(fallen))) continue;
        const double kept = std::sqrt(std::max(0.0, 1 - gained / kinetic));
        b.velocity[i] *= kept;
        b.angular_velocity[i] *= kept;
    }
}

}  // namespace plumb
