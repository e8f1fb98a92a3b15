// SPDX-License-Identifier: MIT
/// What each stage of a step cost.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <string_view>

namespace plumb {

enum class Stage : std::uint32_t {
    detect,             ///< inside the collider's calls
    reuse,              ///< kept contacts brought to the poses now
    match,              ///< contacts checked and matched with those of the step before
    schedule,           ///< colouring, lanes, effective masses
    kinematics,         ///< scripts of moved bodies
    restitution,        ///< which contacts bounce
    impacts,            ///< collisions, before forces
    integrate,          ///< forces and gyroscopic term
    air_drag,           ///< drag of the air
    begin,              ///< gaps, anchor slips and velocities at the start of the substep
    velocities,         ///< velocity pass
    positions,          ///< position pass over contacts
    joints,             ///< joints that are iterated, and their drives, turns and breaking
    trees,              ///< joints that form trees, solved exactly
    divided_trees,      ///< trees that divide their substeps
    particles,          ///< constraints among particles
    links,              ///< links between points
    particle_contacts,  ///< contacts of particles with bodies
    surface_contacts,   ///< points found near surfaces that deform, and kept off them
    islands,            ///< islands solved exactly
    shock,              ///< shock propagation
    residual,           ///< how far the end of the step is from its constraints
    move,               ///< new poses
    tearing,            ///< elements that are strained too far
    still_ground,       ///< energy that the ground gave, taken back
    sleeping,           ///< what falls asleep or wakes
    remember,           ///< impulses kept for the next step
};
inline constexpr std::size_t kStageCount = 27;
inline constexpr std::array<std::string_view, kStageCount> kStageNames{"detect",
                                                                       "reuse",
                                                                       "match",
                                                                       "schedule",
                                                                       "kinematics",
                                                                       "restitution",
                                                                       "impacts",
                                                                       "integrate",
                                                                       "air_drag",
                                                                       "begin",
                                                                       "velocities",
                                                                       "positions",
                                                                       "joints",
                                                                       "trees",
                                                                       "divided_trees",
                                                                       "particles",
                                                                       "links",
                                                                       "particle_contacts",
                                                                       "surface_contacts",
                                                                       "islands",
                                                                       "shock",
                                                                       "residual",
                                                                       "move",
                                                                       "tearing",
                                                                       "still_ground",
                                                                       "sleeping",
                                                                       "remember"};

/// Times [ns] and counts, of one step or summed over many.
struct Ledger {
    std::array<std::uint64_t, kStageCount> nanoseconds{};
    std::array<std::uint64_t, kStageCount> calls{};
    std::uint64_t step_nanoseconds = 0;
    std::chrono::steady_clock::time_point mark{};  ///< when the last timer ended

    std::uint64_t of(Stage s) const { return nanoseconds[static_cast<std::size_t>(s)]; }
    std::uint64_t solver_nanoseconds() const { return step_nanoseconds - of(Stage::detect); }
    /// Of all stages together.
    std::uint64_t booked_nanoseconds() const {
        return std::accumulate(nanoseconds.begin(), nanoseconds.end(), std::uint64_t{0});
    }
};

/// At its end, adds the time since the last timer ended, or the step began, to a stage: what is
/// done between two stages is booked on the later one, and nothing is lost.
class StageTimer {
public:
    StageTimer(Ledger& ledger, Stage stage) : ledger_(ledger), stage_(stage) {}
    ~StageTimer() {
        const auto i = static_cast<std::size_t>(stage_);
        const auto now = std::chrono::steady_clock::now();
        ledger_.nanoseconds[i] += static_cast<std::uint64_t>((now - ledger_.mark).count());
        ledger_.mark = now;
        ++ledger_.calls[i];
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

private:
    Ledger& ledger_;
    Stage stage_;
};

/// Moves the time between its making and its end to a stage from the one that is timed around it.
class ShareTimer {
public:
    ShareTimer(Ledger& ledger, Stage stage, Stage around)
        : ledger_(ledger), stage_(stage), around_(around) {}
    ~ShareTimer() {
        const auto ns =
            static_cast<std::uint64_t>((std::chrono::steady_clock::now() - start_).count());
        // the stage around adds more than this at its end; until then it may stand below nothing
        ledger_.nanoseconds[static_cast<std::size_t>(around_)] -= ns;
        ledger_.nanoseconds[static_cast<std::size_t>(stage_)] += ns;
        ++ledger_.calls[static_cast<std::size_t>(stage_)];
    }
    ShareTimer(const ShareTimer&) = delete;
    ShareTimer& operator=(const ShareTimer&) = delete;

private:
    Ledger& ledger_;
    Stage stage_, around_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace plumb
