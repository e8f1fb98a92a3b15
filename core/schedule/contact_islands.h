// SPDX-License-Identifier: MIT
/// Bodies that touch one another, directly or through others: islands. What is immovable joins
/// nothing.
#pragma once

#include "schedule/colouring.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// One island: ranges of ContactIslands::bodies and ContactIslands::pairs.
struct ContactIsland {
    std::uint32_t first_body, last_body;
    std::uint32_t first_pair, last_pair;
};

/// Reusable memory of a partition. Islands stand in the order of their first body, bodies and pairs
/// of an island in their own.
class ContactIslands {
public:
    void find(const std::vector<BodyPair>& pairs, std::int32_t dynamic_count);

    const std::vector<ContactIsland>& islands() const { return islands_; }
    const std::vector<std::int32_t>& bodies() const { return bodies_; }  ///< rows
    const std::vector<std::uint32_t>& pairs() const { return pairs_; }   ///< indices of pairs
    std::uint32_t index_in_island(std::int32_t row) const { return index_[row]; }

private:
    std::int32_t root(std::int32_t row);

    std::vector<std::int32_t> parent_;   // [dynamic row]
    std::vector<std::uint32_t> island_;  // [dynamic row]
    std::vector<std::uint32_t> index_;   // [dynamic row] place among its island's bodies
    std::vector<ContactIsland> islands_;
    std::vector<std::int32_t> bodies_;
    std::vector<std::uint32_t> pairs_;
};

}  // namespace plumb
