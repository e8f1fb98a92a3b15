// SPDX-License-Identifier: MIT
#include "app/statistics.h"

#include "measure/measure.h"

#include <algorithm>
#include <cmath>

namespace plumb::app {
namespace {

double milliseconds(std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-6; }

double mass_of(const World& world) {
    double sum = 0;
    for (double m : world.bodies.mass) sum += m;
    return sum;
}

}  // namespace

Speeds speeds_of(const std::vector<double>& values) {
    double squares = 0;
    for (double v : values) squares += v * v;
    const double n = values.empty() ? 1 : static_cast<double>(values.size());
    return {percentile(values, 0.5), percentile(values, 0.9), std::sqrt(squares / n),
            percentile(values, 1)};
}

Statistics::Statistics(const Simulation& simulation, std::uint64_t steps) : steps_(steps) {
    const World& world = simulation.world();
    sample_every_ = std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(std::lround(0.1 / world.settings.dt)));
    start_energy = kinetic_energy(world) + potential_energy(world);
    // What moves from outside does work that is not counted here, and overlap at the start is
    // energy too.
    watches_energy_ = world.kinematic_count == 0;
    for (const Vector3d& torque : world.bodies.torque) watches_energy_ &= torque.norm() == 0;
    lowest_potential_ = potential_energy(world);
    allowance_ =
        mass_of(world) * (world.settings.gravity.norm() * 0.1 +
                          0.5 * world.settings.recovery_speed * world.settings.recovery_speed);
}

void Statistics::watch_energy(const Simulation& simulation) {
    if (!watches_energy_) return;
    const World& world = simulation.world();
    const double potential = potential_energy(world), now = kinetic_energy(world) + potential;
    lowest_potential_ = std::min(lowest_potential_, potential);
    const double scale = std::max(start_energy - lowest_potential_, 0.0);
    steps_above_ = now > start_energy + 0.1 * scale + allowance_ ? steps_above_ + 1 : 0;
}

void Statistics::add(const Simulation& simulation, const StepReport& report) {
    const Ledger& ledger = simulation.ledger();
    detect_ms.push_back(milliseconds(ledger.of(Stage::detect)));
    solve_ms.push_back(milliseconds(ledger.solver_nanoseconds()));
    step_ms.push_back(milliseconds(ledger.step_nanoseconds));
    for (std::size_t i = 0; i < kStageCount; ++i) {
        stage_ms[i].push_back(milliseconds(ledger.nanoseconds[i]));
        stage_calls[i] += ledger.calls[i];
    }
    contact_sum += report.contacts;
    contact_max = std::max(contact_max, report.contacts);
    clamped_recoveries += report.clamped_recoveries;
    rejected_contacts += report.rejected_contacts;
    collider_failures += report.collider_failed;
    for (const Contact& c : simulation.world().contacts.found_before)
        worst_penetration_ = std::max(worst_penetration_, -c.gap);
    for (double error : joint_errors(simulation.world()))
        worst_joint_ = std::max(worst_joint_, error);
    watch_energy(simulation);
    const bool last_fifth = simulation.steps() > steps_ - steps_ / 5;
    if ((last_fifth && simulation.steps() % sample_every_ == 0) || simulation.steps() == steps_)
        sample(simulation);
}

void Statistics::sample(const Simulation& simulation) {
    const World& world = simulation.world();
    const Vector3d g = world.settings.gravity;
    const Vector3d up = g.norm() > 0 ? Vector3d(-g.normalized()) : Vector3d(Vector3d::UnitY());
    for (double depth : penetrations(world)) penetration.push_back(depth);
    for (double error : joint_errors(world)) joint_error.push_back(error);
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
        if (world.bodies.motion[i] != Motion::dynamic) continue;
        const double v = world.bodies.velocity[i].norm();
        const Vector3d& x = world.bodies.position[i];
        speed.push_back(v);
        if ((x - up.dot(x) * up).norm() <= kNearRadius) near_speed.push_back(v);
    }
}

}  // namespace plumb::app
