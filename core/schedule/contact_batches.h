// SPDX-License-Identifier: MIT
/// Coloured contacts in lanes: memory of all rows, and where each pair sits in it.
#pragma once

#include "schedule/colouring.h"
#include "schedule/contact_rows.h"
#include "schedule/workers.h"

#include <cstring>
#include <vector>

namespace plumb {

/// Where a contact sits: its lane of a row, and the block of its pair.
struct ContactPlace {
    std::size_t contact, pair;
    std::uint32_t block, row, lane;
};

template <class Real, int W>
class ContactBatches {
public:
    /// Where a pair sits: its lane of a block, whose rows follow each other.
    struct Slot {
        std::uint32_t block, lane;
    };

    /// Lays out zeroed blocks and rows for pairs that `colouring` has coloured.
    void lay_out(const std::vector<BodyPair>& pairs, const Colouring& colouring,
                 ContactVariant variant, std::int32_t zero_row) {
        ranges_.clear();
        slots_.resize(pairs.size());
        std::uint32_t block_count = 0;
        for (const Batch& b : colouring.batches()) {
            const std::uint32_t pairs_here = b.last - b.first;
            const std::uint32_t blocks_here = b.independent ? (pairs_here + W - 1) / W : pairs_here;
            ranges_.push_back({block_count, block_count + blocks_here, b.independent});
            block_count += blocks_here;
        }
        clear(blocks_, block_count);
        std::uint32_t rows = 0;
        for (std::size_t i = 0; i < ranges_.size(); ++i)
            rows = fill_range(ranges_[i], colouring.batches()[i], colouring.order(), pairs,
                              zero_row, rows);
        clear(normals_, rows);
        clear(frictions_, variant != ContactVariant::frictionless ? rows : 0);
        clear(rollings_, variant == ContactVariant::rolling ? rows : 0);
    }

    /// Zeroes the rows, and leaves all pairs where they are, with the masses of their bodies.
    void clear_rows() {
        clear(normals_, normals_.size());
        clear(frictions_, frictions_.size());
        clear(rollings_, rollings_.size());
    }

    /// Calls visit(ContactPlace) for all contacts of the pairs that were laid out, each worker for
    /// those in its share of the blocks: no two write to one line of memory.
    template <class Visit>
    void each_contact(const std::vector<BodyPair>& pairs, Workers& workers, Visit visit) const {
        each_pair(workers, [&](std::size_t p) { each_contact(pairs, p, visit); });
    }
    /// The same for the pairs: visit(pair).
    template <class Visit>
    void each_pair(Workers& workers, Visit visit) const {
        const auto visit_of = [&](Range blocks) __attribute__((flatten)) {
            for (std::size_t p = 0; p < slots_.size(); ++p)
                if (slots_[p].block >= blocks.first && slots_[p].block < blocks.last) visit(p);
        };
        if (slots_.size() < Workers::kFew) return visit_of({0, block_count()});
        workers.run([&](std::uint32_t worker) { visit_of(workers.share(block_count(), worker)); });
    }
    /// The same for those of one pair.
    template <class Visit>
    void each_contact(const std::vector<BodyPair>& pairs, std::size_t pair, Visit visit) const {
        const auto [block, lane] = slots_[pair];
        const std::uint32_t first = blocks_[block].first_row;
        for (std::uint32_t i = 0; i < pairs[pair].count; ++i)
            visit(ContactPlace{pairs[pair].first + i, pair, block, first + i, lane});
    }

    const std::vector<BlockRange>& ranges() const { return ranges_; }
    Slot slot(std::size_t pair) const { return slots_[pair]; }
    std::uint32_t block_count() const { return static_cast<std::uint32_t>(blocks_.size()); }
    std::size_t row_count() const { return normals_.size(); }
    ContactArrays<Real, W> arrays() {
        return {blocks_.data(), normals_.data(), frictions_.data(), rollings_.data()};
    }

private:
    template <class Row>
    static void clear(std::vector<Row>& rows, std::size_t count) {
        rows.resize(count);
        if (count > 0) std::memset(static_cast<void*>(rows.data()), 0, count * sizeof(Row));
    }

    /// Gives the pairs of one batch their blocks and returns the number of rows so far.
    std::uint32_t fill_range(const BlockRange& range, const Batch& batch,
                             const std::vector<std::uint32_t>& order,
                             const std::vector<BodyPair>& pairs, std::int32_t zero_row,
                             std::uint32_t rows) {
        const std::uint32_t width = range.independent ? W : 1;
        for (std::uint32_t b = range.first; b < range.last; ++b) {
            PairBlock<Real, W>& block = blocks_[b];
            for (int lane = 0; lane < W; ++lane) block.row_a[lane] = block.row_b[lane] = zero_row;
            block.first_row = rows;
            const std::uint32_t begin = batch.first + (b - range.first) * width;
            for (std::uint32_t lane = 0; lane < width && begin + lane < batch.last; ++lane) {
                const BodyPair& pair = pairs[order[begin + lane]];
                block.row_a[lane] = pair.row_a;
                block.row_b[lane] = pair.row_b;
                block.row_count = block.row_count > pair.count ? block.row_count : pair.count;
                slots_[order[begin + lane]] = {b, lane};
            }
            rows += block.row_count;
        }
        return rows;
    }

    std::vector<PairBlock<Real, W>> blocks_;
    std::vector<NormalRow<Real, W>> normals_;
    std::vector<FrictionRow<Real, W>> frictions_;
    std::vector<RollingRow<Real, W>> rollings_;
    std::vector<BlockRange> ranges_;
    std::vector<Slot> slots_;
};

}  // namespace plumb
