// SPDX-License-Identifier: MIT
/// When an island beyond Settings::exact_islands is solved exactly all the same.
///
/// Sweeps carry a heap as well as anybody can see, and let a high wall fall: how large an island is
/// does not tell them apart, what its sweeps miss does. So a large island is swept until it rests
/// and its contacts still miss more than Settings::accuracy. From the next step on it is solved
/// exactly, for as long as it rests; from the first step on where most of its contacts are new, and
/// have no impulses to start from. What moves is swept: the forces in it change from step
/// to step, and what is missed of them is not seen. How much is spent on one in vain is told in
/// island_account.h.
#pragma once

#include "scene/settings.h"
#include "solve/island_residuals.h"
#include "world/world.h"

#include <cstdint>

namespace plumb {

inline bool is_large(const Settings& settings, std::uint32_t bodies) {
    return bodies > settings.exact_islands;
}

/// It rests where its contacts slide, part and approach by less than this share of what gravity
/// and constant forces add in a substep, in the root of the mean square.
inline constexpr double kRestsBelow = 0.7;

/// After a step: which large islands are to be solved exactly in the next one.
void note_what_misses(World& world, const IslandResiduals& residuals);

}  // namespace plumb
