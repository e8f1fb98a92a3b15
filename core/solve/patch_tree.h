// SPDX-License-Identifier: MIT
/// The elements of deformables, halved again and again into patches.
#pragma once

#include "math/types.h"
#include "scene/geometry.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// Elements [first, last) in the tree's order, and their points: [point, point_end) of
/// PatchTree::points.
struct Patch {
    std::uint32_t first, last;
    std::uint32_t point, point_end;
    std::uint32_t parent;   ///< stands before it; kNoIndex where it is a whole deformable
    std::uint32_t half[2];  ///< stand behind it; kNoIndex where it is one of the smallest
    bool is_smallest() const { return half[0] == kNoIndex; }
};

/// A point of a patch, and where it is among those of its two halves, if it is. Of the smallest
/// patches: corners [from[0], from[1]) of PatchTree::corners.
struct PatchPoint {
    std::uint32_t particle;
    std::uint32_t from[2];
};

class PatchTree {
public:
    /// An element with its corners, and the place of its middle at rest [m].
    struct Element {
        std::vector<std::uint32_t> particles;
        Vector3d middle;
    };

    /// Elements by deformables, which end at `ends` and have a tree each, unless they have fewer
    /// than `least`. The smallest patches have at least so many, and fewer than twice as many.
    PatchTree(const std::vector<Element>& elements, const std::vector<std::uint32_t>& ends,
              std::uint32_t least);

    const std::vector<std::uint32_t>& order() const { return order_; }  ///< elements
    const std::vector<Patch>& patches() const { return patches_; }
    const std::vector<PatchPoint>& points() const { return points_; }
    /// Of the smallest patches: place of an element in the order, times its number of corners, plus
    /// the corner's.
    const std::vector<std::uint32_t>& corners() const { return corners_; }

private:
    std::uint32_t split(const std::vector<Element>& elements, std::uint32_t first,
                        std::uint32_t last, std::uint32_t least, std::uint32_t parent);
    void find_points(const std::vector<Element>& elements);

    std::vector<std::uint32_t> order_, corners_;
    std::vector<Patch> patches_;
    std::vector<PatchPoint> points_;
};

}  // namespace plumb
