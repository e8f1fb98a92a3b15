// SPDX-License-Identifier: MIT
/// Figures that are gathered while a run goes on.
#pragma once

#include "host/simulation.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumb::app {

/// Speeds of dynamic bodies [m/s].
struct Speeds {
    double median = 0, p90 = 0, rms = 0, max = 0;
};
Speeds speeds_of(const std::vector<double>& values);

class Statistics {
public:
    /// Bodies within this distance of the vertical axis are also told about by themselves [m].
    static constexpr double kNearRadius = 8;

    Statistics(const Simulation& simulation, std::uint64_t steps);

    /// Takes what the step that was just made tells.
    void add(const Simulation& simulation, const StepReport& report);

    /// Deepest penetration and widest joint gap so far [m].
    double worst_penetration() const { return worst_penetration_; }
    double worst_joint() const { return worst_joint_; }

    /// Whether the energy has run away: ten steps above what the run began with and could have
    /// gained by 10 %.
    bool energy_ran_away() const { return steps_above_ >= 10; }

    std::vector<double> detect_ms, solve_ms, step_ms;
    std::array<std::vector<double>, kStageCount> stage_ms;
    std::array<std::uint64_t, kStageCount> stage_calls{};
    double contact_sum = 0;
    std::uint32_t contact_max = 0;
    std::uint64_t clamped_recoveries = 0, rejected_contacts = 0, collider_failures = 0;
    std::vector<double> penetration, speed, near_speed, joint_error;  ///< over the last fifth
    double start_energy = 0;                                          ///< [J]

private:
    void watch_energy(const Simulation& simulation);
    void sample(const Simulation& simulation);

    std::uint64_t steps_, sample_every_;
    double worst_penetration_ = 0, worst_joint_ = 0;
    double lowest_potential_ = 0, allowance_ = 0;
    bool watches_energy_ = false;
    int steps_above_ = 0;
};

}  // namespace plumb::app
