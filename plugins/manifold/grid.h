// SPDX-License-Identifier: MIT
/// A broad phase of equal cells.
#pragma once

#include "manifold/body_table.h"

namespace plumb {

/// Keeps its memory between calls, and nothing else.
class Grid {
public:
    /// Adds all pairs of parts whose bounds overlap and that are to be tested. Any order.
    void find_pairs(std::vector<PartPair>& pairs, const BodyTable& table);

private:
    /// Cells that a part covers, from low to high on each axis.
    struct Range {
        std::int32_t low[3], high[3];
    };
    struct Entry {
        std::int32_t cell[3];
        std::uint32_t part;
        std::uint32_t is_low;  ///< a bit an axis: whether the part covers no lower cell along it
    };

    double cell_size(const BodyTable& table);
    static bool meet_here(const Entry& p, const Entry& q);
    void enter(std::uint32_t part, const Range& r);
    void sort_into_cells(const BodyTable& table, double size);
    void meet_in_cell(std::vector<PartPair>& pairs, const BodyTable& table, std::uint32_t begin,
                      std::uint32_t end);

    std::vector<double> sizes_;
    std::vector<std::uint32_t> large_;    ///< parts that cover too many cells, or have no bounds
    std::vector<std::uint8_t> is_large_;  ///< [part]
    std::vector<Entry> loose_, sorted_;  ///< a part once for every cell it covers; sorted by bucket
    std::vector<std::uint32_t> bucket_;  ///< [bucket + 1] where it begins in sorted_
};

}  // namespace plumb
