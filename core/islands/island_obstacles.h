// SPDX-License-Identifier: MIT
/// What keeps islands from being solved exactly: what is beyond their solver, ties that turn far or
/// pull hard within a substep, and such as could not be closed a while ago.
#pragma once

#include "schedule/contact_islands.h"
#include "world/tie.h"

#include <cstdint>
#include <vector>

namespace plumb {

class IslandObstacles {
public:
    // bits, of which an island may have several
    static constexpr std::uint8_t kBeyond = 1;   ///< particles, or joints that are iterated
    static constexpr std::uint8_t kFast = 2;     ///< a tie turns far within a substep,
    static constexpr std::uint8_t kHard = 4;     ///< or farther, or pulls hard: others do no better
    static constexpr std::uint8_t kRests = 8;    ///< a tie could not be closed (IslandRest)
    static constexpr std::uint8_t kPulled = 16;  ///< a joint pulls hard, and is at rest

    /// Once a step: marks the bodies of what is in the way, and those of ties that are solved
    /// elsewhere.
    void find(const World& world, const std::vector<Tie>& ties, const SolvedTies& solved);

    /// All that bodies of an island are marked with.
    std::uint8_t of(const ContactIslands& found, const ContactIsland& island) const;

private:
    void put(const World& world, std::uint32_t body, std::uint8_t obstacle);

    std::vector<std::uint8_t> marks_;  // [dynamic row]
};

}  // namespace plumb
