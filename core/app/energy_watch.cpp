// SPDX-License-Identifier: MIT
#include "app/energy_watch.h"

#include "measure/measure.h"

#include <algorithm>

namespace plumb::app {

EnergyWatch::EnergyWatch(const World& world)
    : start_(kinetic_energy(world) + potential_energy(world)),
      last_(start_),
      lowest_potential_(potential_energy(world)),
      // what deforms stores energy that is not in the sum
      watches_(world.kinematic_count == 0 && world.particles.size() == 0) {
    for (const Vector3d& torque : world.bodies.torque) watches_ &= torque.norm() == 0;
    for (const JointDrive& drive : world.joints.drives)
        watches_ &= drive.kind != DriveKind::motor && drive.kind != DriveKind::spring;
    for (double m : world.bodies.mass) mass_ += m;
    const double speed = world.settings.recovery_speed;
    slack_ = mass_ * (world.settings.gravity.norm() * 0.1 + 0.5 * speed * speed);
}

/// Each clamped contact parts its bodies at the recovery speed at most; in a chain of them the
/// speeds add up.
double EnergyWatch::push_limit(const World& world, const StepReport& report) const {
    const double chain = std::min<double>(report.clamped_recoveries, world.dynamic_count);
    const double speed = chain * world.settings.recovery_speed;
    const double lift = world.settings.gravity.norm() * speed * world.settings.dt;
    return mass_ * (lift + 0.5 * speed * speed);
}

void EnergyWatch::add(const World& world, const StepReport& report) {
    if (!watches_) return;
    const double potential = potential_energy(world), now = kinetic_energy(world) + potential;
    pushed_ += std::clamp(now - last_, 0.0, push_limit(world, report));
    last_ = now;
    lowest_potential_ = std::min(lowest_potential_, potential);
    const double turnover = std::max(start_ - lowest_potential_, 0.0);
    steps_above_ = now > start_ + 0.1 * turnover + slack_ + pushed_ ? steps_above_ + 1 : 0;
}

}  // namespace plumb::app
