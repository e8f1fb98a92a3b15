// SPDX-License-Identifier: MIT
#include "app/energy_watch.h"

#include "measure/measure.h"

#include <algorithm>
#include <cmath>

namespace plumb::app {
namespace {

double surface_area(const DeformableSpec& surface) {
    double sum = 0;
    for (const auto& t : surface.triangles) {
        const Vector3d& a = surface.points[t[0]];
        sum += 0.5 * (surface.points[t[1]] - a).cross(surface.points[t[2]] - a).norm();
    }
    return sum;
}

/// What it takes to stretch the skins of balloons until they hold the volumes that they keep, twice
/// over: they are filled in the first steps [J].
double filling_energy(const World& world) {
    double sum = 0;
    for (const Deformable& d : world.deformables) {
        if (d.spec.kind != DeformableKind::balloon || d.spec.pressure) continue;
        const double strain = std::cbrt(d.spec.volume_ratio) - 1;
        sum += 2 * strain * strain * d.spec.elasticity.youngs_modulus * d.spec.thickness *
               surface_area(d.spec) / (1 - d.spec.elasticity.poissons_ratio);
    }
    return sum;
}

/// Whether all work that is done on what moves is counted.
bool counts_all_work(const World& world) {
    if (world.kinematic_count > 0 || world.settings.wind) return false;
    const auto drives = [](const JointDrive& drive) {
        return drive.kind == DriveKind::motor || drive.kind == DriveKind::spring;
    };
    const auto is_spring = [](const Link& link) { return link.compliance > 0; };
    const auto pushes = [](const Vector3d& torque) { return torque.norm() > 0; };
    return std::none_of(world.joints.drives.begin(), world.joints.drives.end(), drives) &&
           std::none_of(world.links.begin(), world.links.end(), is_spring) &&
           std::none_of(world.bodies.torque.begin(), world.bodies.torque.end(), pushes);
}

}  // namespace

EnergyWatch::EnergyWatch(const World& world)
    : start_(kinetic_energy(world) + potential_energy(world)),
      last_(start_),
      lowest_potential_(potential_energy(world)),
      pushed_(filling_energy(world)),
      watches_(counts_all_work(world)) {
    for (const double m : world.bodies.mass) mass_ += m;
    for (const double m : world.particles.mass) mass_ += m;
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
