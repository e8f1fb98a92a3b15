// SPDX-License-Identifier: MIT
/// Boxes sorted into the cells of a grid, to be found by points. Its memory is reused.
#pragma once

#include "math/types.h"

#include <cstdint>
#include <vector>

namespace plumb {

class BoxGrid {
public:
    /// Sorts boxes [low, high] into cells of a side that suits their mean extent.
    void build(const std::vector<Vector3d>& low, const std::vector<Vector3d>& high);

    /// Calls visit(box) for the boxes of the point's cell, and some others, each once.
    template <class Visit>
    void each_near(const Vector3d& point, Visit visit) {
        for (const std::uint32_t box : large_) visit(box);
        if (first_.empty()) return;
        ++stamp_;
        const std::uint32_t bucket = bucket_of(cell_of(point));
        for (std::uint32_t i = first_[bucket]; i < first_[bucket + 1]; ++i) {
            if (seen_[boxes_[i]] == stamp_) continue;
            seen_[boxes_[i]] = stamp_;
            visit(boxes_[i]);
        }
    }

private:
    struct Cell {
        std::int64_t x, y, z;
    };
    Cell cell_of(const Vector3d& p) const;
    std::uint32_t bucket_of(const Cell& c) const;

    /// Calls visit(bucket) for each cell of a box; false where there are too many.
    template <class Visit>
    bool each_cell(const Vector3d& low, const Vector3d& high, Visit visit) const;

    double side_ = 1;
    std::uint32_t mask_ = 0;
    std::uint64_t stamp_ = 0;
    std::vector<std::uint32_t> first_, boxes_, large_;
    std::vector<std::uint64_t> seen_;
};

}  // namespace plumb
