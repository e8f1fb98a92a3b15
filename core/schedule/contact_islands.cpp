// SPDX-License-Identifier: MIT
#include "schedule/contact_islands.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plumb {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// Brings a value up to date; returns whether it was.
template <class Value>
bool keep(Value& kept, const Value& now) {
    return std::exchange(kept, now) == now;
}
template <class Rows>
bool keep_rows(Rows& kept, const std::vector<BodyPair>& pairs) {
    const bool known =
        std::equal(kept.begin(), kept.end(), pairs.begin(), pairs.end(),
                   [](const auto& rows, const BodyPair& p) { return rows == rows_of(p); });
    if (known) return true;
    kept.resize(pairs.size());
    std::transform(pairs.begin(), pairs.end(), kept.begin(),
                   [](const BodyPair& p) { return rows_of(p); });
    return false;
}

}  // namespace

std::int32_t ContactIslands::root(std::int32_t row) {
    while (parent_[row] != row) row = parent_[row] = parent_[parent_[row]];
    return row;
}

/// The least row of an island becomes its root, so that a body's island is known when its turn
/// comes.
void ContactIslands::join(const std::vector<BodyPair>& pairs) {
    const auto count = static_cast<std::int32_t>(parent_.size());
    for (const BodyPair& p : pairs)
        if (p.row_a < count && p.row_b < count) {
            const std::int32_t a = root(p.row_a), b = root(p.row_b);
            parent_[std::max(a, b)] = std::min(a, b);
        }
}

void ContactIslands::find(const std::vector<BodyPair>& pairs, const std::vector<BodyPair>& ties,
                          std::size_t first_seed, std::int32_t dynamic_count) {
    const bool alike = keep_rows(rows_of_pairs_, pairs) & keep_rows(rows_of_ties_, ties) &
                       keep(first_seed_, first_seed) & keep(dynamic_count_, dynamic_count);
    if (alike) return;
    parent_.resize(dynamic_count);
    std::iota(parent_.begin(), parent_.end(), 0);
    island_.assign(dynamic_count, kNone);
    index_.assign(dynamic_count, 0);
    islands_.clear();
    join(pairs), join(ties);
    const auto begin_island = [&](const BodyPair& p) {
        for (const std::int32_t row : {p.row_a, p.row_b})
            if (row < dynamic_count) island_[root(row)] = 0;
    };
    for (const BodyPair& p : pairs) begin_island(p);
    for (std::size_t i = first_seed; i < ties.size(); ++i) begin_island(ties[i]);
    for (std::int32_t row = 0; row < dynamic_count; ++row) {
        const std::int32_t r = root(row);
        if (island_[r] == kNone) continue;
        if (r == row) {
            island_[row] = static_cast<std::uint32_t>(islands_.size());
            islands_.push_back({0, 0, 0, 0, 0, 0});
        }
        island_[row] = island_[r];
        ++islands_[island_[row]].last_body;
    }
    std::uint32_t count = 0;
    for (ContactIsland& i : islands_) {
        i.first_body = count, count += i.last_body, i.last_body = i.first_body;
    }
    bodies_.resize(count);
    for (std::int32_t row = 0; row < dynamic_count; ++row) {
        if (island_[row] == kNone) continue;
        ContactIsland& i = islands_[island_[row]];
        index_[row] = i.last_body - i.first_body;
        bodies_[i.last_body++] = row;
    }
    sort(pairs, &ContactIsland::first_pair, &ContactIsland::last_pair, pairs_);
    sort(ties, &ContactIsland::first_tie, &ContactIsland::last_tie, ties_);
}

/// Indices of pairs, island by island; of islands, where theirs begin and end.
void ContactIslands::sort(const std::vector<BodyPair>& pairs, std::uint32_t ContactIsland::*first,
                          std::uint32_t ContactIsland::*last, std::vector<std::uint32_t>& sorted) {
    const auto count = static_cast<std::int32_t>(island_.size());
    const auto island_of = [&](const BodyPair& p) {
        const std::int32_t row = p.row_a < count ? p.row_a : p.row_b;
        return row < count ? island_[row] : kNone;
    };
    for (const BodyPair& p : pairs)
        if (island_of(p) != kNone) ++(islands_[island_of(p)].*last);
    std::uint32_t total = 0;
    for (ContactIsland& i : islands_) {
        i.*first = total, total += i.*last, i.*last = i.*first;
    }
    sorted.resize(total);
    for (std::uint32_t k = 0; k < pairs.size(); ++k)
        if (island_of(pairs[k]) != kNone) sorted[(islands_[island_of(pairs[k])].*last)++] = k;
}

}  // namespace plumb
