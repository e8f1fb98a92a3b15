// SPDX-License-Identifier: MIT
/// Bodies that touch one another, or that are tied to those, directly or through others: islands.
/// What is immovable joins nothing.
#pragma once

#include "schedule/colouring.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

/// One island: ranges of ContactIslands::bodies, pairs and ties.
struct ContactIsland {
    std::uint32_t first_body, last_body;
    std::uint32_t first_pair, last_pair;
    std::uint32_t first_tie, last_tie;
};

/// Reusable memory of a partition. Islands stand in the order of their first body, bodies, pairs
/// and ties of an island in their own.
class ContactIslands {
public:
    /// Memory for so many islands, however the pairs fall into them.
    void reserve(std::size_t islands) { islands_.reserve(islands); }

    /// `ties`: bodies that are held together. Where nothing touches there is no island, but for
    /// what the ties from `first_seed` on hold. What rests is mostly asked for as it was the last
    /// time, and then nothing is done.
    void find(const std::vector<BodyPair>& pairs, const std::vector<BodyPair>& ties,
              std::size_t first_seed, std::int32_t dynamic_count);

    const std::vector<ContactIsland>& islands() const { return islands_; }
    const std::vector<std::int32_t>& bodies() const { return bodies_; }  ///< rows
    const std::vector<std::uint32_t>& pairs() const { return pairs_; }   ///< indices of pairs
    const std::vector<std::uint32_t>& ties() const { return ties_; }     ///< indices of ties
    /// [dynamic row] index of the body's island, ~0u where it has none.
    const std::vector<std::uint32_t>& island_of() const { return island_; }
    std::uint32_t index_in_island(std::int32_t row) const { return index_[row]; }

private:
    using Rows = std::vector<std::array<std::int32_t, 2>>;

    std::int32_t root(std::int32_t row);
    void join(const std::vector<BodyPair>& pairs);
    void sort(const std::vector<BodyPair>& pairs, std::uint32_t ContactIsland::*first,
              std::uint32_t ContactIsland::*last, std::vector<std::uint32_t>& sorted);

    // what was asked for
    Rows rows_of_pairs_, rows_of_ties_;
    std::size_t first_seed_ = 0;
    std::int32_t dynamic_count_ = 0;

    std::vector<std::int32_t> parent_;   // [dynamic row]
    std::vector<std::uint32_t> island_;  // [dynamic row]
    std::vector<std::uint32_t> index_;   // [dynamic row] place among its island's bodies
    std::vector<ContactIsland> islands_;
    std::vector<std::int32_t> bodies_;
    std::vector<std::uint32_t> pairs_, ties_;
};

}  // namespace plumb
