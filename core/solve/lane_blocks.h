// SPDX-License-Identifier: MIT
/// Joints laid out in blocks of W lanes, colour by colour, and iterated in that order. They are
/// laid out when the world changes, not at each step.
#pragma once

#include "kernels/joint_kernels.h"
#include "schedule/colouring.h"
#include "schedule/workers.h"
#include "solve/fill_mass.h"
#include "solve/island_residuals.h"
#include "world/world.h"

#include <vector>

namespace plumb {

template <class Block, class Real, int W>
class LaneBlocks {
public:
    /// `pairs`: the two bodies of each item, with its level.
    void lay_out(const std::vector<BodyPair>& pairs, const World& world) {
        blocks_.clear(), ranges_.clear();
        places_.resize(pairs.size());
        colouring_.colour(pairs, world.moving_count());
        for (const Batch& batch : colouring_.batches()) {
            const std::uint32_t width = batch.independent ? W : 1;
            const auto first = static_cast<std::uint32_t>(blocks_.size());
            for (std::uint32_t i = batch.first; i < batch.last; i += width)
                add_block(pairs, world.zero_row(), i, std::min(i + width, batch.last));
            ranges_.push_back(
                {first, static_cast<std::uint32_t>(blocks_.size()), batch.independent});
        }
    }

    bool empty() const { return places_.empty(); }
    std::size_t size() const { return places_.size(); }
    std::size_t block_count() const { return blocks_.size(); }
    Block* data() { return blocks_.data(); }
    std::uint32_t index(std::size_t item) const { return places_[item].block; }
    Block& block(std::size_t item) { return blocks_[places_[item].block]; }
    std::uint32_t lane(std::size_t item) const { return places_[item].lane; }

    /// Puts the masses of an item's bodies into its lane; b may be kNoIndex.
    void fill_masses(std::size_t item, const Bodies& bodies, std::uint32_t a, std::uint32_t b) {
        Block& to = block(item);
        fill_mass(bodies, a, to.inverse_mass_a, to.inverse_inertia_a, lane(item));
        if (b != kNoIndex)
            fill_mass(bodies, b, to.inverse_mass_b, to.inverse_inertia_b, lane(item));
    }

    /// One iteration over all blocks; every worker takes its share of blocks that are independent,
    /// and waits for the others.
    void iterate(JointPass<Block, Real> pass, const BodyRows<Real>& bodies, Real h,
                 Workers& workers, std::uint32_t worker) {
        for (const BlockRange& range : ranges_) {
            Range share = workers.share(range.last - range.first, worker);
            if (!range.independent)
                share = worker == 0 ? Range{0, range.last - range.first} : Range{0, 0};
            pass(blocks_.data(), bodies, h, range.first + share.first, range.first + share.last);
            workers.barrier();
        }
    }

    /// The residuals of those items of which `counts(item)`, after the last iteration, in their
    /// order.
    template <class Counts>
    void add_residuals(IslandResiduals& islands, JointResidualPass<Block, Real, W> pass,
                       const BodyRows<Real>& bodies, Real h, Counts counts) {
        residuals_.resize(blocks_.size());
        pass(residuals_.data(), blocks_.data(), bodies, h, 0,
             static_cast<std::uint32_t>(blocks_.size()));
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (!counts(i)) continue;
            const auto [block, lane] = places_[i];
            const PairResidual<Real, W>& r = residuals_[block];
            islands.add(blocks_[block].row_a[lane], blocks_[block].row_b[lane],
                        swept_residual(r, lane, 1));
        }
    }

private:
    struct Place {
        std::uint32_t block, lane;
    };

    void add_block(const std::vector<BodyPair>& pairs, std::int32_t zero_row, std::uint32_t first,
                   std::uint32_t last) {
        Block& block = blocks_.emplace_back();
        for (int lane = 0; lane < W; ++lane) block.row_a[lane] = block.row_b[lane] = zero_row;
        for (std::uint32_t i = first; i < last; ++i) {
            const std::uint32_t item = colouring_.order()[i], lane = i - first;
            places_[item] = {static_cast<std::uint32_t>(blocks_.size()) - 1, lane};
            block.row_a[lane] = pairs[item].row_a;
            block.row_b[lane] = pairs[item].row_b;
        }
    }

    Colouring colouring_;
    std::vector<Block> blocks_;
    std::vector<BlockRange> ranges_;
    std::vector<Place> places_;
    std::vector<PairResidual<Real, W>> residuals_;  // [block]
};

}  // namespace plumb
