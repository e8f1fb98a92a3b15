// SPDX-License-Identifier: MIT
#include "app/energy_watch.h"

#include "measure/measure.h"
#include "world/link_error.h"

#include <algorithm>

namespace plumb::app {
namespace {

/// A link that is farther off than this when a run begins does work as it draws its points together
/// [m].
constexpr double kClosed = 1e-3;

/// What deforms may be given so much as it is pushed out of what it begins in [J/kg].
constexpr double kGiven = 10;

bool does_work(const JointDrive& drive) {
    return drive.kind == DriveKind::motor || drive.kind == DriveKind::spring;
}
bool does_work(const World& world, const Link& link) {
    return link.compliance > 0 || link_error(world, link) > kClosed;
}
/// It is pumped up or down to its volume.
bool does_work(const Deformable& d) { return d.spec.pressure || d.spec.volume_ratio != 1; }

/// Whether all work that is done on what moves is counted.
bool counts_all_work(const World& world) {
    if (world.kinematic_count > 0 || world.settings.wind) return false;
    const auto& drives = world.joints.drives;
    const auto& torques = world.bodies.torque;
    return std::none_of(drives.begin(), drives.end(),
                        [](const JointDrive& drive) { return does_work(drive); }) &&
           std::none_of(world.links.begin(), world.links.end(),
                        [&](const Link& link) { return does_work(world, link); }) &&
           std::none_of(world.deformables.begin(), world.deformables.end(),
                        [](const Deformable& d) { return does_work(d); }) &&
           std::none_of(torques.begin(), torques.end(),
                        [](const Vector3d& torque) { return torque.norm() > 0; });
}

/// Of particles that nothing holds [kg].
double moving_mass(const Particles& p) {
    double mass = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.inverse_mass[i] > 0) mass += p.mass[i];
    return mass;
}

}  // namespace

EnergyWatch::EnergyWatch(const World& world)
    : start_(kinetic_energy(world) + potential_energy(world)),
      last_(start_),
      lowest_potential_(potential_energy(world)),
      watches_(counts_all_work(world)) {
    for (const double m : world.bodies.mass) mass_ += m;
    const double speed = world.settings.recovery_speed;
    slack_ = mass_ * (world.settings.gravity.norm() * 0.1 + 0.5 * speed * speed) +
             moving_mass(world.particles) * kGiven;
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
