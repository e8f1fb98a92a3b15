// SPDX-License-Identifier: MIT
/// The summed impulses of contact rows that the next substep begins from.
#pragma once

#include "schedule/colouring.h"
#include "schedule/contact_rows.h"

#include <algorithm>
#include <vector>

namespace plumb {

/// Calls visit(Real*) for each of those sums of row k, [lane].
template <class Real, int W, class Visit>
inline void each_sum(const ContactArrays<Real, W>& rows, std::size_t k, Visit visit) {
    NormalRow<Real, W>& row = rows.normals[k];
    visit(row.lambda_velocity), visit(row.lambda_position);
    if (!rows.frictions) return;
    FrictionRow<Real, W>& across = rows.frictions[k];
    visit(across.lambda_velocity_x), visit(across.lambda_velocity_y);
    visit(across.lambda_position_x), visit(across.lambda_position_y);
}

/// Those of the rows of some blocks, put aside while the rows serve another purpose.
template <class Real, int W>
class ContactImpulses {
public:
    /// Takes the memory for `count` rows.
    void reserve(const ContactArrays<Real, W>& rows, std::size_t count) {
        sums_.reserve(count * (rows.frictions ? 6 : 2) * W);
    }

    void take(const ContactArrays<Real, W>& rows, const std::vector<BlockRange>& blocks) {
        sums_.clear();
        each_row(rows, blocks, [&](const Real* sum) { sums_.insert(sums_.end(), sum, sum + W); });
    }

    /// Gives back what was taken from the same rows.
    void give(const ContactArrays<Real, W>& rows, const std::vector<BlockRange>& blocks) const {
        auto from = sums_.begin();
        each_row(rows, blocks, [&](Real* sum) {
            std::copy_n(from, W, sum);
            from += W;
        });
    }

private:
    template <class Visit>
    static void each_row(const ContactArrays<Real, W>& rows, const std::vector<BlockRange>& blocks,
                         Visit visit) {
        for (const BlockRange& range : blocks)
            for (std::uint32_t b = range.first; b < range.last; ++b)
                for (std::uint32_t k = 0; k < rows.blocks[b].row_count; ++k)
                    each_sum(rows, rows.blocks[b].first_row + k, visit);
    }

    std::vector<Real> sums_;
};

}  // namespace plumb
