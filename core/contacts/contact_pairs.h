// SPDX-License-Identifier: MIT
/// Contacts grouped by their two bodies, and bodies ordered by how far they stand from the ground.
#pragma once

#include "schedule/colouring.h"
#include "world/world.h"

#include <tuple>
#include <vector>

namespace plumb {

/// The two bodies of a contact or a pair, by which both are sorted.
template <class Pair>
std::tuple<std::uint32_t, std::uint32_t> bodies_of(const Pair& pair) {
    return {pair.a, pair.b};
}

/// End of the run of contacts that share the pair of contact `i`.
inline std::size_t end_of_pair(const std::vector<Contact>& contacts, std::size_t i) {
    std::size_t end = i + 1;
    while (end < contacts.size() && bodies_of(contacts[end]) == bodies_of(contacts[i])) ++end;
    return end;
}

/// The table's pairs by the rows of their bodies. With levels, a pair is solved after those nearer
/// to the ground.
void find_pairs(const World& world, const std::vector<std::uint32_t>* levels,
                std::vector<BodyPair>& pairs);

/// Distance of each body, in contacts, from what is immovable (§6, shock propagation). Bodies that
/// hang in the air share the level above the highest.
void find_levels(const World& world, std::vector<std::uint32_t>& levels);

}  // namespace plumb
