// SPDX-License-Identifier: MIT
#include "schedule/colouring.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace plumb {
namespace {

/// Stable counting sort of `order` by key(item), keys in [0, keys).
template <class Key>
void counting_sort(std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& scratch,
                   std::vector<std::uint32_t>& buckets, std::uint32_t keys, Key key) {
    buckets.assign(keys + 1, 0);
    for (std::uint32_t i : order) ++buckets[key(i) + 1];
    for (std::uint32_t k = 0; k < keys; ++k) buckets[k + 1] += buckets[k];
    scratch.resize(order.size());
    for (std::uint32_t i : order) scratch[buckets[key(i)]++] = i;
    order.swap(scratch);
}

}  // namespace

void Colouring::colour(const std::vector<BodyPair>& pairs, std::int32_t dynamic_count) {
    assign_colours(pairs, dynamic_count);
    sort_pairs(pairs);

    batches_.clear();
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
        const std::uint32_t pair = order_[i];
        const bool same = i > 0 && colour_[order_[i - 1]] == colour_[pair] &&
                          pairs[order_[i - 1]].level == pairs[pair].level;
        if (same)
            ++batches_.back().last;
        else
            batches_.push_back({i, i + 1, colour_[pair] < kMaxColours});
    }
}

/// First fit, in the order of the levels and within a level in the order of the pairs.
void Colouring::assign_colours(const std::vector<BodyPair>& pairs, std::int32_t dynamic_count) {
    const auto n = static_cast<std::uint32_t>(pairs.size());
    std::uint32_t levels = 1;
    for (const BodyPair& p : pairs) levels = std::max(levels, p.level + 1);
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), 0u);
    if (levels > 1)
        counting_sort(order_, scratch_, buckets_, levels,
                      [&](std::uint32_t i) { return pairs[i].level; });

    colour_.resize(n);
    std::uint32_t level = ~0u;
    for (std::uint32_t i : order_) {
        const BodyPair& p = pairs[i];
        if (p.level != level)
            taken_.assign(static_cast<std::size_t>(dynamic_count), 0), level = p.level;
        const bool a = p.row_a < dynamic_count, b = p.row_b < dynamic_count;
        const std::uint64_t taken = (a ? taken_[p.row_a] : 0) | (b ? taken_[p.row_b] : 0);
        const auto free = std::min<std::uint32_t>(std::countr_one(taken), kMaxColours);
        colour_[i] = static_cast<std::uint8_t>(free);
        if (free == kMaxColours) continue;
        if (a) taken_[p.row_a] |= 1ull << free;
        if (b) taken_[p.row_b] |= 1ull << free;
    }
}

/// By level, then colour, then falling number of rows: full blocks first. Overflow keeps its order.
void Colouring::sort_pairs(const std::vector<BodyPair>& pairs) {
    std::uint32_t most = 0, levels = 1;
    for (const BodyPair& p : pairs)
        most = std::max(most, p.count), levels = std::max(levels, p.level + 1);
    counting_sort(order_, scratch_, buckets_, most + 1, [&](std::uint32_t i) {
        return colour_[i] == kMaxColours ? 0 : most - pairs[i].count;
    });
    counting_sort(order_, scratch_, buckets_, kMaxColours + 1,
                  [&](std::uint32_t i) { return colour_[i]; });
    if (levels > 1)
        counting_sort(order_, scratch_, buckets_, levels,
                      [&](std::uint32_t i) { return pairs[i].level; });
}

}  // namespace plumb
