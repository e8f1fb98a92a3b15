// SPDX-License-Identifier: MIT
/// Bodies that touch one another, or that joints link to those, directly or through others:
/// islands. What is immovable joins nothing.
#pragma once

#include "schedule/colouring.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// One island: ranges of ContactIslands::bodies, pairs and links.
struct ContactIsland {
    std::uint32_t first_body, last_body;
    std::uint32_t first_pair, last_pair;
    std::uint32_t first_link, last_link;
};

/// Reusable memory of a partition. Islands stand in the order of their first body, bodies, pairs
/// and links of an island in their own.
class ContactIslands {
public:
    /// `links`: bodies that joints hold together. Where nothing touches there is no island.
    void find(const std::vector<BodyPair>& pairs, const std::vector<BodyPair>& links,
              std::int32_t dynamic_count);

    const std::vector<ContactIsland>& islands() const { return islands_; }
    const std::vector<std::int32_t>& bodies() const { return bodies_; }  ///< rows
    const std::vector<std::uint32_t>& pairs() const { return pairs_; }   ///< indices of pairs
    const std::vector<std::uint32_t>& links() const { return links_; }   ///< indices of links
    std::uint32_t index_in_island(std::int32_t row) const { return index_[row]; }

private:
    std::int32_t root(std::int32_t row);
    void join(const std::vector<BodyPair>& pairs);
    void sort(const std::vector<BodyPair>& pairs, std::uint32_t ContactIsland::*first,
              std::uint32_t ContactIsland::*last, std::vector<std::uint32_t>& sorted);

    std::vector<std::int32_t> parent_;   // [dynamic row]
    std::vector<std::uint32_t> island_;  // [dynamic row]
    std::vector<std::uint32_t> index_;   // [dynamic row] place among its island's bodies
    std::vector<ContactIsland> islands_;
    std::vector<std::int32_t> bodies_;
    std::vector<std::uint32_t> pairs_, links_;
};

}  // namespace plumb
