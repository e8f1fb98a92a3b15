// SPDX-License-Identifier: MIT
/// When an island beyond Settings::exact_islands is solved exactly all the same.
///
/// Sweeps carry a heap as well as anybody can see, and let a high wall fall: how large an island is
/// does not tell them apart, what its sweeps miss does. So a large island is swept until it rests
/// and its contacts still miss more than Settings::accuracy. From the next step on it is solved
/// exactly, for as long as it rests; from the first step on where most of its contacts are new, and
/// have no impulses to start from. What moves is swept: the forces in it change from step
/// to step, and what is missed of them is not seen.
#pragma once

#include "effects/residual.h"
#include "scene/settings.h"

#include <algorithm>
#include <cstdint>

namespace plumb {

inline bool is_large(const Settings& settings, std::uint32_t bodies) {
    return bodies > settings.exact_islands;
}

/// It rests where its contacts slide, part and approach by less than this share of what gravity
/// and constant forces add in a substep, in the root of the mean square.
inline constexpr double kRestsBelow = 0.7;

/// What its factorisations in a substep may take, in products of two 6 × 6 blocks: up to ten
/// seconds. One that could not have kFewest of them is left to sweeps; a wall of 3600 bricks can.
inline constexpr std::uint64_t kMostProducts = 100'000'000, kFewest = 30;

/// A structure finds its forces in some thirty factorisations, or in a hundred once it is jolted. A
/// large heap that has just settled misses its laws after hundreds, and in each substep again,
/// though sweeps carry it well. So what is taken in vain is summed up, less what a step may take
/// freely, until the island is solved once. One that comes to more than kMostInVain units is swept
/// for the rest of the step, and for a while.
inline constexpr std::uint8_t kMostInVain = 60;

/// A unit of large islands [products], and how many of them are free.
inline constexpr std::uint64_t kLargeUnit = 2'500'000, kFreeUnits = 4;

/// A smaller heap, of more than kHeap bodies, takes in vain most while it moves, a step's forces
/// being of no use to the next. Its unit is so many of its own factorisations, and it may take
/// fewer. One that was given up is tried again as soon as it rests. If sweeps do not bring it to
/// rest, it is solved as far as that goes until it does.
inline constexpr std::uint64_t kHeapUnit = 8;
inline constexpr std::uint8_t kMostOfHeap = 20;

/// Whether the contacts of an island miss more than `accuracy`.
inline bool misses(const IslandResidual& island, double accuracy) {
    return island.rms_force * island.bodies > accuracy * island.weight;
}

/// What was to be exact and misses so many times the accuracy is left to sweeps for a while.
inline constexpr double kFails = 10;

/// ContactMemory::missed: 0 where sweeps will do for the island of the contact; where it is to be
/// solved exactly, 1 and what has been taken in vain [units]. Above that it waits for so many times
/// kTick steps until it is tried again: kTriesAgain where its system was too large or it missed far
/// too much, kInVain where it is large and has taken all that it may, kHeapInVain where it is a
/// smaller heap.
inline constexpr std::uint8_t kMissed = 1, kTriesAgain = 77, kHeapInVain = 93, kInVain = 255;
inline constexpr std::uint64_t kTick = 8;
inline bool waits(std::uint8_t missed) { return missed > kMissed + kMostInVain; }

/// Units taken in vain, as they are remembered.
inline std::uint64_t in_vain_of(std::uint8_t missed) {
    return missed > kMissed ? missed - kMissed : 0u;
}
inline std::uint8_t missed_after(std::uint64_t units) {
    return static_cast<std::uint8_t>(kMissed + std::min<std::uint64_t>(kMostInVain, units));
}

/// After a step in which the island was swept. `step`: how many there were.
inline std::uint8_t missed_after_sweeps(std::uint8_t missed, std::uint64_t step) {
    if (!waits(missed)) return 0;
    const std::uint8_t left = missed - (step % kTick == 0);
    return waits(left) ? left : 0;
}

}  // namespace plumb
