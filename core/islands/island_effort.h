// SPDX-License-Identifier: MIT
/// How much is done for an island, from step to step.
///
/// Overlap that is to be opened and slip that is to be taken back can contradict each other: no
/// velocities do both, and a wedged heap that is asked for them is never at rest. So an island that
/// could not be solved, or overlaps too deeply for that, is disputed for a while: it is asked for
/// neither. At first sweeps of their own open what gives way. They shift the bodies and leave their
/// velocities alone, in which they would keep a heap swaying for ever. Once nothing overlaps by
/// much, or what is wedged no longer gives way, all stays as it is until something disturbs it.
#pragma once

#include <cstdint>

namespace plumb {

/// A heap has more than so many bodies.
inline constexpr std::size_t kHeap = 64;

enum class IslandEffort : std::uint8_t {
    full,   ///< solved until its laws hold, overlap and slip among them
    swept,  ///< disputed: opened apart, and solved with little work; else improved by sweeps
    light,  ///< solved with little work; overlap and slip stay as they are
};

/// For how many steps a disputed island is swept, and then solved lightly.
inline constexpr std::uint8_t kSweptSteps = 64, kLightSteps = 64;

/// It is swept on while a contact overlaps by more than this share of its smaller body's radius;
/// where some overlap is too deep for an exact solution, as long as all overlaps come to less than
/// this share of what they were so many steps before.
inline constexpr double kShallow = 0.005, kGivesWay = 0.9;

/// An island whose laws hold is left as it is, with the impulses of the step before. Such as change
/// velocities, as those do that take back an overlap, would go on doing so. So once it is solved
/// anew, it is solved to a finer tolerance for so many steps, until little of that is left.
inline constexpr std::uint8_t kSettlingSteps = 32;

/// `disputed`: the steps that are left of the dispute.
inline IslandEffort effort_of(std::uint8_t disputed) {
    if (disputed == 0) return IslandEffort::full;
    return disputed > kLightSteps ? IslandEffort::swept : IslandEffort::light;
}

/// At the start of a dispute.
inline constexpr std::uint8_t kDisputed = kSweptSteps + kLightSteps;

/// Whether it is swept for the last time.
inline bool ends_sweeping(std::uint8_t disputed) { return disputed == kLightSteps + 1; }

/// Steps that are left after one. A dispute lasts while what is asked lightly is solved.
inline std::uint8_t disputed_after(std::uint8_t disputed, bool solved) {
    switch (effort_of(disputed)) {
        case IslandEffort::full:
            return solved ? 0 : kDisputed;
        case IslandEffort::swept:
            return disputed - 1;
        case IslandEffort::light:
            break;
    }
    return solved ? disputed : disputed - 1;
}

}  // namespace plumb
