// SPDX-License-Identifier: MIT
/// Where the factor of a sparse symmetric matrix has entries, and in which order its columns are
/// best stored.
#pragma once

#include "math/row_graph.h"

#include <cstdint>
#include <span>
#include <vector>

namespace plumb {

/// Reusable memory for one matrix after another.
class Fill {
public:
    /// Changes an order of elimination, [place] row, to one of the same fill in which the columns
    /// that a column changes (its children are those that change it first) come right before it.
    /// `place`: [row] its place before.
    void put_children_first(std::vector<std::uint32_t>& order, const RowGraph& graph,
                            const std::vector<std::uint32_t>& place);

    /// Finds the fill of columns whose own rows below the diagonal are those of `own`, rising, from
    /// own_first[column] on. Returns whether the elimination takes no more than `most` products.
    bool find(const std::vector<std::uint32_t>& own_first, const std::vector<std::uint32_t>& own,
              double most);

    /// Rows below the diagonal, rising.
    std::span<const std::uint32_t> below(std::uint32_t column) const {
        const Range& range = below_[column];
        return {rows_.data() + range.first, rows_.data() + range.last};
    }

private:
    struct Range {
        std::size_t first, last;
    };

    void find_parents(const std::vector<std::uint32_t>& order, const RowGraph& graph,
                      const std::vector<std::uint32_t>& place);
    void list_children();
    Range widened(Range range);

    std::vector<std::uint32_t> parent_, ancestor_;
    std::vector<std::uint32_t> child_, sibling_;  // the first one, the next one
    std::vector<std::uint32_t> open_, order_;
    std::vector<Range> below_;  // [column] in rows_, which some of them share
    std::vector<std::uint32_t> rows_;
    std::vector<std::uint32_t> seen_, more_;
};

}  // namespace plumb
