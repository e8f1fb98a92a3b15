// SPDX-License-Identifier: MIT
/// Contacts grouped by their two bodies, and bodies ordered by how far they stand from the ground.
#pragma once

#include "schedule/colouring.h"
#include "world/world.h"

#include <vector>

namespace plumb {

/// End of the run of contacts that share the pair of contact `i`.
inline std::size_t end_of_pair(const std::vector<Contact>& contacts, std::size_t i) {
    std::size_t end = i + 1;
    while (end < contacts.size() && contacts[end].a == contacts[i].a &&
           contacts[end].b == contacts[i].b)
        ++end;
    return end;
}

/// Groups neighbouring contacts of one pair. With levels, a pair is solved after those nearer to
/// the ground.
void find_pairs(const World& world, const std::vector<std::uint32_t>* levels,
                std::vector<BodyPair>& pairs);

/// Distance of each body, in contacts, from what is immovable (§6, shock propagation). Bodies that
/// hang in the air share the level above the highest.
void find_levels(const World& world, std::vector<std::uint32_t>& levels);

}  // namespace plumb
