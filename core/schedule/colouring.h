// SPDX-License-Identifier: MIT
/// Which pairs of bodies may be solved at the same time.
///
/// Two pairs of one colour share no dynamic body; immovable bodies do not count, or 500 bodies on
/// one floor would take 500 colours. Colours are capped: what finds none free goes to an overflow
/// that is solved one pair after another. The result depends on the pairs and their order alone,
/// not on lanes or threads.
#pragma once

#include <cstdint>
#include <vector>

namespace plumb {

/// A pair of bodies and how many rows it has.
struct BodyPair {
    std::int32_t row_a, row_b;   ///< rows in the velocity table
    std::uint32_t first, count;  ///< its constraints
    std::uint32_t level = 0;     ///< levels are solved one after another, lowest first
};

/// One batch: pairs that may run at the same time, or (when not) in their order.
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
    /// Colours the pairs. Within a batch, pairs with more rows come first; `order` lists pairs
    /// batch by batch.
    void colour(const std::vector<BodyPair>& pairs, std::int32_t dynamic_count);

    const std::vector<std::uint32_t>& order() const { return order_; }
    const std::vector<Batch>& batches() const { return batches_; }

    static constexpr std::uint32_t kMaxColours = 63;  ///< the 64th stands for overflow

private:
    void assign_colours(const std::vector<BodyPair>& pairs, std::int32_t dynamic_count);
    void sort_pairs(const std::vector<BodyPair>& pairs);

    std::vector<std::uint64_t> taken_;  // [dynamic body], one bit a colour
    std::vector<std::uint8_t> colour_;  // [pair]
    std::vector<std::uint32_t> order_, scratch_, buckets_;
    std::vector<std::uint32_t> by_level_;
    std::vector<Batch> batches_;
};

}  // namespace plumb
