// SPDX-License-Identifier: MIT
/// Figures that are gathered while a run goes on.
#pragma once

#include "app/energy_watch.h"
#include "app/joint_watch.h"
#include "app/residual_watch.h"
#include "host/simulation.h"

#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace plumb::app {

/// Speeds of dynamic bodies or of particles [m/s].
struct Speeds {
    double median = 0, p90 = 0, rms = 0, max = 0;
};
Speeds speeds_of(const std::vector<double>& values);

/// What bodies and particles do at one moment.
struct Sample {
    double time = 0;                                           ///< [s]
    std::vector<double> penetration, joint_error, link_error;  ///< [pair], [joint], [link], [m]
    std::vector<double> joint_turn_error;                      ///< [joint], [rad]
    std::vector<double> speed, near_speed;                     ///< [dynamic body], [m/s]
    std::vector<double> particle_speed;                        ///< of those that can move [m/s]
    std::vector<double> strain, volume_error;  ///< [deformable], [balloon that keeps a volume]
};

class Statistics {
public:
    /// Bodies within this distance of the vertical axis are also told about by themselves [m].
    static constexpr double kNearRadius = 8;

    explicit Statistics(const Simulation& simulation);

    /// Takes what the step that was just made tells.
    void add(const Simulation& simulation, const StepReport& report);

    /// Takes the bodies as they are at the end of the run.
    void finish(const Simulation& simulation);

    /// Values of one kind over the last fifth of the run: each tenth of a second, and at its end.
    std::vector<double> over_last_fifth(std::vector<double> Sample::*values) const;

    /// Deepest penetration and widest joint gap so far [m].
    double worst_penetration() const { return worst_penetration_; }
    double worst_joint() const { return worst_joint_; }

    const JointWatch& joints() const { return joints_; }
    const EnergyWatch& energy() const { return energy_; }
    const ResidualWatch& residual() const { return residual_; }

    std::vector<double> detect_ms, solve_ms, step_ms;
    std::array<std::vector<double>, kStageCount> stage_ms;
    std::array<std::uint64_t, kStageCount> stage_calls{};
    double contact_sum = 0;
    double tree_error = 0;              ///< StepReport::tree_error, the greatest
    std::uint64_t stretched_links = 0;  ///< StepReport::stretched_links, of all steps
    double link_error = 0;              ///< StepReport::link_error, the greatest [m]
    std::uint32_t contact_max = 0;
    std::uint32_t asleep_max = 0, asleep_end = 0;  ///< StepReport::asleep
    std::uint64_t clamped_recoveries = 0, unsolved_islands = 0, costly_islands = 0,
                  unsolved_trees = 0, coarse_trees = 0, rejected_contacts = 0,
                  collider_failures = 0;
    std::uint64_t torn = 0;                                  ///< elements of deformables
    std::uint64_t broken = 0;                                ///< joints that gave way
    std::array<std::uint64_t, kContactFaultCount> faults{};  ///< contacts left out, by fault
    std::string first_failure;                               ///< what the collider said

private:
    void add_times(const Ledger& ledger);

    JointWatch joints_;
    EnergyWatch energy_;
    ResidualWatch residual_;
    std::uint64_t sample_every_;  ///< steps
    std::deque<Sample> samples_;
    bool finite_ = true;
    double worst_penetration_ = 0, worst_joint_ = 0;
};

}  // namespace plumb::app
