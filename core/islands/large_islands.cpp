// SPDX-License-Identifier: MIT
#include "islands/large_islands.h"

#include "effects/residual.h"
#include "islands/island_account.h"

#include <algorithm>

namespace plumb {
namespace {

/// What was to be exact and misses so many times the accuracy is left to sweeps for a while.
constexpr double kFails = 10;

/// Whether the contacts of an island miss more than `accuracy`.
bool misses(const IslandResidual& island, double accuracy) {
    return island.rms_force * island.bodies > accuracy * island.weight;
}

}  // namespace

void note_what_misses(World& world, const IslandResiduals& residuals) {
    const Settings& s = world.settings;
    const auto needs_more = [&](const IslandResidual& island) {
        return is_large(s, island.bodies) && misses(island, s.accuracy);
    };
    const auto note = [&](ContactMemory& memory, const IslandResidual& island) {
        const bool fails = memory.exact && misses(island, kFails * s.accuracy);
        memory.missed = std::max(memory.missed, fails ? kTriesAgain : kMissed);
    };
    const std::vector<IslandResidual>& all = residuals.islands();
    if (!(s.accuracy > 0) || std::none_of(all.begin(), all.end(), needs_more)) return;
    ContactTable& c = world.contacts;
    for (const ContactPair& pair : c.pairs) {
        const std::int32_t a = world.bodies.row[pair.a], b = world.bodies.row[pair.b];
        const IslandResidual* island = residuals.of(std::min(a, b));
        if (!island || !needs_more(*island)) continue;
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            note(c.memory[k], *island);
    }
}

}  // namespace plumb
