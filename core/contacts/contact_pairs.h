// SPDX-License-Identifier: MIT
/// Contacts grouped by their two bodies, and bodies ordered by how far they stand from the ground.
#pragma once

#include "schedule/colouring.h"
#include "world/world.h"

#include <vector>

namespace plumb {

/// Groups neighbouring contacts of one pair. With levels, a pair is solved after those nearer to
/// the ground.
void find_pairs(const World& world, const std::vector<std::uint32_t>* levels,
                std::vector<BodyPair>& pairs);

/// Distance of each body, in contacts, from what is immovable (§6, shock propagation). Bodies that
/// hang in the air share the level above the highest.
void find_levels(const World& world, std::vector<std::uint32_t>& levels);

}  // namespace plumb
