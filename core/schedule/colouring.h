// SPDX-License-Identifier: MIT
/// Which constraints may be solved at the same time.
///
/// Two constraints of one colour share no row of the velocity table that changes; immovable bodies
/// do not count, or 500 bodies on one floor would take 500 colours. Colours are capped: what finds
/// none free goes to an overflow that is solved one after another. The result depends on the
/// constraints and their order alone, not on lanes or threads.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <vector>

namespace plumb {

/// A pair of bodies and how many rows it has.
struct BodyPair {
    std::int32_t row_a, row_b;   ///< rows in the velocity table
    std::uint32_t first, count;  ///< its constraints
    std::uint32_t level = 0;     ///< levels are solved one after another, lowest first
};

inline std::array<std::int32_t, 2> rows_of(const BodyPair& pair) {
    return {pair.row_a, pair.row_b};
}

/// A constraint among N points: the rows of their bodies and particles.
template <int N>
struct LinkedRows {
    std::array<std::int32_t, N> rows;  ///< in the velocity table
    std::uint32_t count = 1, level = 0;
};

template <int N>
inline const std::array<std::int32_t, N>& rows_of(const LinkedRows<N>& item) {
    return item.rows;
}

/// One batch: items that may run at the same time, or (when not) in their order.
struct Batch {
    std::uint32_t first, last;  ///< range in Colouring::order
    bool independent;
};

/// Blocks [first, last) of one batch.
struct BlockRange {
    std::uint32_t first, last;
    bool independent;  ///< whether the blocks may run at the same time
};

/// Reusable memory of a colouring.
class Colouring {
public:
    /// Colours the items: BodyPair or LinkedRows. Within a batch, those with more rows come first;
    /// `order` lists items batch by batch. `dynamic_count`: rows that change.
    template <class Item>
    void colour(const std::vector<Item>& items, std::int32_t dynamic_count) {
        assign_colours(items, dynamic_count);
        sort(items);
        batches_.clear();
        for (std::uint32_t i = 0; i < order_.size(); ++i) {
            const std::uint32_t item = order_[i];
            const bool same = i > 0 && colour_[order_[i - 1]] == colour_[item] &&
                              items[order_[i - 1]].level == items[item].level;
            if (same)
                ++batches_.back().last;
            else
                batches_.push_back({i, i + 1, colour_[item] < kMaxColours});
        }
    }

    const std::vector<std::uint32_t>& order() const { return order_; }
    const std::vector<Batch>& batches() const { return batches_; }

    static constexpr std::uint32_t kMaxColours = 63;  ///< the 64th stands for overflow

private:
    /// First fit, in the order of the levels and within a level in the order of the items.
    template <class Item>
    void assign_colours(const std::vector<Item>& items, std::int32_t dynamic_count) {
        const auto n = static_cast<std::uint32_t>(items.size());
        std::uint32_t levels = 1;
        for (const Item& item : items) levels = std::max(levels, item.level + 1);
        order_.resize(n);
        std::iota(order_.begin(), order_.end(), 0u);
        if (levels > 1) sort_by(levels, [&](std::uint32_t i) { return items[i].level; });

        colour_.resize(n);
        std::uint32_t level = ~0u;
        for (const std::uint32_t i : order_) {
            const Item& item = items[i];
            if (item.level != level)
                taken_.assign(static_cast<std::size_t>(dynamic_count), 0), level = item.level;
            std::uint64_t taken = 0;
            for (const std::int32_t row : rows_of(item))
                if (row < dynamic_count) taken |= taken_[row];
            const auto free = std::min<std::uint32_t>(std::countr_one(taken), kMaxColours);
            colour_[i] = static_cast<std::uint8_t>(free);
            if (free == kMaxColours) continue;
            for (const std::int32_t row : rows_of(item))
                if (row < dynamic_count) taken_[row] |= 1ull << free;
        }
    }

    /// By level, then colour, then falling number of rows: full blocks first. Overflow keeps its
    /// order.
    template <class Item>
    void sort(const std::vector<Item>& items) {
        std::uint32_t most = 0, levels = 1;
        for (const Item& item : items)
            most = std::max(most, item.count), levels = std::max(levels, item.level + 1);
        sort_by(most + 1, [&](std::uint32_t i) {
            return colour_[i] == kMaxColours ? 0 : most - items[i].count;
        });
        sort_by(kMaxColours + 1, [&](std::uint32_t i) { return colour_[i]; });
        if (levels > 1) sort_by(levels, [&](std::uint32_t i) { return items[i].level; });
    }

    /// Stable counting sort of `order_` by key(item), keys in [0, keys).
    template <class Key>
    void sort_by(std::uint32_t keys, Key key) {
        buckets_.assign(keys + 1, 0);
        for (const std::uint32_t i : order_) ++buckets_[key(i) + 1];
        for (std::uint32_t k = 0; k < keys; ++k) buckets_[k + 1] += buckets_[k];
        scratch_.resize(order_.size());
        for (const std::uint32_t i : order_) scratch_[buckets_[key(i)]++] = i;
        order_.swap(scratch_);
    }

    std::vector<std::uint64_t> taken_;  // [row that changes], one bit a colour
    std::vector<std::uint8_t> colour_;  // [item]
    std::vector<std::uint32_t> order_, scratch_, buckets_;
    std::vector<Batch> batches_;
};

}  // namespace plumb
