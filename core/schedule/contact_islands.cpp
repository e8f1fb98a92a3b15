// SPDX-License-Identifier: MIT
#include "schedule/contact_islands.h"

#include <algorithm>
#include <numeric>

namespace plumb {

std::int32_t ContactIslands::root(std::int32_t row) {
    while (parent_[row] != row) row = parent_[row] = parent_[parent_[row]];
    return row;
}

void ContactIslands::find(const std::vector<BodyPair>& pairs, std::int32_t dynamic_count) {
    constexpr std::uint32_t kNone = ~0u;
    parent_.resize(dynamic_count);
    std::iota(parent_.begin(), parent_.end(), 0);
    island_.assign(dynamic_count, kNone);
    index_.assign(dynamic_count, 0);
    islands_.clear();
    const auto moves = [&](std::int32_t row) { return row < dynamic_count; };
    for (const BodyPair& p : pairs)
        if (moves(p.row_a) && moves(p.row_b)) {
            const std::int32_t a = root(p.row_a), b = root(p.row_b);
            parent_[std::max(a, b)] = std::min(a, b);
        }
    // the least row of an island is its root, so that a body's island is known when its turn comes
    for (const BodyPair& p : pairs)
        for (const std::int32_t row : {p.row_a, p.row_b})
            if (moves(row)) island_[root(row)] = 0;
    for (std::int32_t row = 0; row < dynamic_count; ++row) {
        const std::int32_t r = root(row);
        if (island_[r] == kNone) continue;
        if (r == row) {
            island_[row] = static_cast<std::uint32_t>(islands_.size());
            islands_.push_back({0, 0, 0, 0});
        }
        island_[row] = island_[r];
        ++islands_[island_[row]].last_body;
    }
    const auto island_of = [&](const BodyPair& p) {
        return island_[moves(p.row_a) ? p.row_a : p.row_b];
    };
    for (const BodyPair& p : pairs)
        if (moves(p.row_a) || moves(p.row_b)) ++islands_[island_of(p)].last_pair;

    std::uint32_t body_count = 0, pair_count = 0;
    for (ContactIsland& i : islands_) {
        i.first_body = body_count, body_count += i.last_body, i.last_body = i.first_body;
        i.first_pair = pair_count, pair_count += i.last_pair, i.last_pair = i.first_pair;
    }
    bodies_.resize(body_count);
    pairs_.resize(pair_count);
    for (std::int32_t row = 0; row < dynamic_count; ++row) {
        if (island_[row] == kNone) continue;
        ContactIsland& i = islands_[island_[row]];
        index_[row] = i.last_body - i.first_body;
        bodies_[i.last_body++] = row;
    }
    for (std::uint32_t k = 0; k < pairs.size(); ++k) {
        if (!moves(pairs[k].row_a) && !moves(pairs[k].row_b)) continue;
        ContactIsland& i = islands_[island_of(pairs[k])];
        pairs_[i.last_pair++] = k;
    }
}

}  // namespace plumb
