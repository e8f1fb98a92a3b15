// SPDX-License-Identifier: MIT
/// Sparse symmetric systems of 6 × 6 blocks, a block row a body: A = L Lᵀ by elimination in an
/// order that keeps fill small (least degree first).
///
/// `analyse` once for a pattern, then any number of times: `clear`, add to blocks, `factor`,
/// `solve`.
#pragma once

#include "math/row_graph.h"
#include "math/types.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace plumb {

class BlockCholesky {
public:
    /// Off-diagonal blocks that are not zero, as pairs of block rows below `rows`; a pair may come
    /// more than once, in either order.
    using Pattern = RowGraph::Pairs;

    /// Memory for so many rows, of which few hang together.
    void reserve(std::uint32_t rows);

    /// Chooses the order of elimination and finds the fill. Returns whether `factor` takes no more
    /// than `most` products; if it does, nothing is kept.
    bool analyse(std::uint32_t rows, const Pattern& pattern,
                 std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

    std::uint32_t rows() const { return static_cast<std::uint32_t>(order_.size()); }

    /// Products of two 6 × 6 blocks that `factor` takes.
    std::uint64_t block_products() const { return products_; }

    void clear();

    /// Adds to the diagonal block of row i.
    void add(std::uint32_t i, const Matrix6d& block) { diagonal_[place_[i]] += block; }

    /// Adds `block` to A(i, j), and its transpose to A(j, i). The pair is in the pattern.
    void add(std::uint32_t i, std::uint32_t j, const Matrix6d& block);

    /// Adds x yᵀ to A(i, j), and its transpose to A(j, i) unless that is the same block. The pair
    /// is in the pattern.
    void add_product(std::uint32_t i, const Vector6d& x, std::uint32_t j, const Vector6d& y);

    /// Returns whether all pivots were positive.
    bool factor();

    /// x ← A⁻¹ x.
    void solve(std::vector<Vector6d>& x);

private:
    /// Blocks [first, last) below the diagonal of one column, rows rising.
    struct Column {
        std::uint32_t first, last;
    };
    struct Range {
        std::size_t first, last;
        std::size_t size() const { return last - first; }
    };
    std::uint32_t slot(std::uint32_t row, std::uint32_t column) const;
    bool find_order(const Pattern& pattern, std::uint64_t most);
    void make_near(std::uint32_t i, std::uint32_t eliminated);
    void find_updates();

    std::vector<std::uint32_t> order_, place_;  // [place] block row; [block row] place
    std::vector<Column> columns_;               // [place]
    std::vector<std::uint32_t> row_of_;         // [slot] place of the block's row
    std::vector<std::uint32_t> updates_;        // slots that an elimination changes, in its order
    std::vector<Matrix6d> diagonal_, below_;    // [place], [slot]
    std::vector<Vector6d> permuted_;
    // memory of `find_order`: neighbours that are not yet eliminated, and those of what was
    RowGraph graph_;
    std::vector<Range> near_;  // [block row] in list_
    std::vector<std::uint32_t> list_, merged_;
    std::vector<std::uint8_t> done_;
    std::uint64_t products_ = 0;
};

}  // namespace plumb
