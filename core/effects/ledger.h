// SPDX-License-Identifier: MIT
/// What each stage of a step cost.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

namespace plumb {

enum class Stage : std::uint32_t {
    detect,        ///< inside the collider's calls
    reuse,         ///< kept contacts brought to the poses now
    match,         ///< contacts checked and matched with those of the step before
    schedule,      ///< colouring, lanes, effective masses
    kinematics,    ///< scripts of moved bodies
    restitution,   ///< which contacts bounce
    impacts,       ///< collisions, before forces
    integrate,     ///< forces and gyroscopic term
    begin,         ///< gaps, drifts and velocities at the start of the substep
    velocities,    ///< velocity pass
    positions,     ///< position pass
    islands,       ///< islands solved exactly
    shock,         ///< shock propagation
    move,          ///< new poses
    still_ground,  ///< energy that the ground gave, taken back
    remember,      ///< impulses kept for the next step
};
inline constexpr std::size_t kStageCount = 16;
inline constexpr std::array<std::string_view, kStageCount> kStageNames{
    "detect",  "reuse",     "match",        "schedule",   "kinematics", "restitution",
    "impacts", "integrate", "begin",        "velocities", "positions",  "islands",
    "shock",   "move",      "still_ground", "remember"};

/// Times [ns] and counts, of one step or summed over many.
struct Ledger {
    std::array<std::uint64_t, kStageCount> nanoseconds{};
    std::array<std::uint64_t, kStageCount> calls{};
    std::uint64_t step_nanoseconds = 0;

    std::uint64_t of(Stage s) const { return nanoseconds[static_cast<std::size_t>(s)]; }
    std::uint64_t solver_nanoseconds() const { return step_nanoseconds - of(Stage::detect); }
};

/// Adds the time between its making and its end to a stage.
class StageTimer {
public:
    StageTimer(Ledger& ledger, Stage stage) : ledger_(ledger), stage_(stage) {}
    ~StageTimer() {
        const auto i = static_cast<std::size_t>(stage_);
        ledger_.nanoseconds[i] +=
            static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(
                                           std::chrono::steady_clock::now() - start_)
                                           .count());
        ++ledger_.calls[i];
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

private:
    Ledger& ledger_;
    Stage stage_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace plumb
