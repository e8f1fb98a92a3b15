// SPDX-License-Identifier: MIT
#include "app/statistics.h"

#include "measure/deformation.h"
#include "measure/measure.h"
#include "world/sleep.h"

#include <algorithm>
#include <cmath>

namespace plumb::app {
namespace {

double milliseconds(std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-6; }

Sample sample_of(const World& world) {
    const Vector3d g = world.settings.gravity;
    const Vector3d up = g.norm() > 0 ? Vector3d(-g.normalized()) : Vector3d(Vector3d::UnitY());
    Sample sample{world.time,
                  penetrations(world),
                  joint_errors(world),
                  link_errors(world),
                  joint_turn_errors(world),
                  {},
                  {},
                  {},
                  strains(world),
                  {}};
    for (const double error : volume_errors(world)) sample.volume_error.push_back(std::abs(error));
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
        if (!is_movable(world.bodies.motion[i])) continue;
        const double v = world.bodies.velocity[i].norm();
        const Vector3d& x = world.bodies.position[i];
        sample.speed.push_back(v);
        if ((x - up.dot(x) * up).norm() <= Statistics::kNearRadius) sample.near_speed.push_back(v);
    }
    for (std::size_t i = 0; i < world.particles.size(); ++i)
        if (world.particles.inverse_mass[i] > 0)
            sample.particle_speed.push_back(world.particles.velocity[i].norm());
    return sample;
}

}  // namespace

Speeds speeds_of(const std::vector<double>& values) {
    double squares = 0;
    for (double v : values) squares += v * v;
    const double n = values.empty() ? 1 : static_cast<double>(values.size());
    return {percentile(values, 0.5), percentile(values, 0.9), std::sqrt(squares / n),
            percentile(values, 1)};
}

Statistics::Statistics(const Simulation& simulation)
    : energy_(simulation.world()),
      sample_every_(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(std::lround(0.1 / simulation.world().settings.dt)))) {}

void Statistics::add_times(const Ledger& ledger) {
    detect_ms.push_back(milliseconds(ledger.of(Stage::detect)));
    solve_ms.push_back(milliseconds(ledger.solver_nanoseconds()));
    step_ms.push_back(milliseconds(ledger.step_nanoseconds));
    for (std::size_t i = 0; i < kStageCount; ++i) {
        stage_ms[i].push_back(milliseconds(ledger.nanoseconds[i]));
        stage_calls[i] += ledger.calls[i];
    }
}

void Statistics::add(const Simulation& simulation, const StepReport& report) {
    const World& world = simulation.world();
    add_times(simulation.ledger());
    contact_sum += report.contacts;
    contact_max = std::max(contact_max, report.contacts);
    asleep_end = report.asleep;
    asleep_max = std::max(asleep_max, report.asleep);
    clamped_recoveries += report.clamped_recoveries;
    unsolved_islands += report.unsolved_islands;
    costly_islands += report.costly_islands;
    unsolved_trees += report.unsolved_trees;
    coarse_trees += report.coarse_trees;
    torn += report.torn_elements;
    broken += report.broken_joints;
    tree_error = std::max(tree_error, report.tree_error);
    stretched_links += report.stretched_links;
    link_error = std::max(link_error, report.link_error);
    rejected_contacts += report.rejected_contacts;
    for (std::size_t i = 0; i < kContactFaultCount; ++i) faults[i] += report.faults[i];
    if (report.collider_failed && collider_failures == 0) first_failure = report.message;
    collider_failures += report.collider_failed;
    finite_ &= report.finite;
    if (!finite_) return;  // figures of the bodies are those of the steps before

    for (const Contact& c : world.contacts.found)
        worst_penetration_ = std::max(worst_penetration_, -c.gap);
    for (const double gap : joint_errors(world)) worst_joint_ = std::max(worst_joint_, gap);
    joints_.add(world, report);
    energy_.add(world, report);
    residual_.add(world, report);
    if (simulation.steps() % sample_every_ == 0) samples_.push_back(sample_of(world));
    while (!samples_.empty() && samples_.front().time <= 0.8 * world.time) samples_.pop_front();
}

void Statistics::finish(const Simulation& simulation) {
    if (!finite_) return;
    if (samples_.empty() || samples_.back().time < simulation.time())
        samples_.push_back(sample_of(simulation.world()));
}

std::vector<double> Statistics::over_last_fifth(std::vector<double> Sample::*values) const {
    std::vector<double> all;
    for (const Sample& s : samples_) all.insert(all.end(), (s.*values).begin(), (s.*values).end());
    return all;
}

}  // namespace plumb::app
