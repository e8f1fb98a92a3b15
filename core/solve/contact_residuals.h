// SPDX-License-Identifier: MIT
/// Residuals of contact rows, gathered by islands.
#pragma once

#include "kernels/contact_kernels.h"
#include "schedule/contact_batches.h"
#include "schedule/workers.h"
#include "solve/island_residuals.h"

#include <vector>

namespace plumb {

/// Reusable memory of those of all blocks.
template <class Real, int W>
class ContactResiduals {
public:
    /// Adds those of the pairs, in their order: how they lie in lanes makes no difference.
    void add_to(IslandResiduals& islands, ContactBatches<Real, W>& batches,
                const std::vector<BodyPair>& pairs, ResidualPass<Real, W> kernel,
                const BodyRows<Real>& bodies, const PassSettings<Real>& pass, Workers& workers) {
        blocks_.resize(batches.block_count());
        workers.run([&](std::uint32_t worker) {
            const Range share = workers.share(batches.block_count(), worker);
            kernel(blocks_.data(), batches.arrays(), bodies, pass, share.first, share.last);
        });
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            const auto [block, lane] = batches.slot(p);
            const PairResidual<Real, W>& r = blocks_[block];
            islands.add(pairs[p].row_a, pairs[p].row_b, swept_residual(r, lane, pairs[p].count));
        }
    }

private:
    std::vector<PairResidual<Real, W>> blocks_;
};

}  // namespace plumb
