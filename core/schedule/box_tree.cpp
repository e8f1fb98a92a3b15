// SPDX-License-Identifier: MIT
#include "schedule/box_tree.h"

#include <limits>
#include <numeric>
#include <utility>

namespace plumb {

void BoxTree::build(const std::vector<Vector3d>& middles,
                    const std::vector<std::uint32_t>& groups) {
    order_.resize(middles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    levels_.clear(), nodes_.clear();
    if (order_.empty()) return;
    split(middles, groups, 0, static_cast<std::uint32_t>(order_.size()));

    std::uint32_t below = static_cast<std::uint32_t>(order_.size());
    do {
        below = (below + kChildren - 1) / kChildren;
        levels_.push_back({0, below});
    } while (below > 1);
    std::reverse(levels_.begin(), levels_.end());
    std::uint32_t nodes = 0;
    for (Level& level : levels_) level.first = std::exchange(nodes, nodes + level.count);
    Node empty;
    for (auto& bounds : empty.at)
        std::fill(std::begin(bounds), std::end(bounds), std::numeric_limits<float>::infinity());
    nodes_.assign(nodes, empty);
}

/// Halves across the longest extent, the first half of as many boxes as fill a subtree.
void BoxTree::split(const std::vector<Vector3d>& middles, const std::vector<std::uint32_t>& groups,
                    std::uint32_t first, std::uint32_t last) {
    if (last - first < 2) return;
    const std::uint32_t middle = first + std::bit_floor(last - first - 1);
    if (groups[order_[first]] == groups[order_[last - 1]]) {
        Vector3d low = middles[order_[first]], high = low;
        for (std::uint32_t i = first; i < last; ++i) {
            low = low.cwiseMin(middles[order_[i]]);
            high = high.cwiseMax(middles[order_[i]]);
        }
        Eigen::Index axis = 0;
        (high - low).maxCoeff(&axis);
        std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                         [&](std::uint32_t a, std::uint32_t b) {
                             return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
                         });
    }
    split(middles, groups, first, middle);
    split(middles, groups, middle, last);
}

void BoxTree::set(std::uint32_t level, std::uint32_t child, const Bounds& bounds) {
    Node& node = nodes_[levels_[level].first + child / kChildren];
    for (int k = 0; k < 6; ++k) node.at[k][child % kChildren] = bounds.at[k];
}

BoxTree::Bounds BoxTree::bounds_of_node(const Node& node) const {
    Bounds all;
    for (int k = 0; k < 6; ++k)
        all.at[k] = *std::min_element(std::begin(node.at[k]), std::end(node.at[k]));
    return all;
}

void BoxTree::close() {
    for (auto level = static_cast<std::uint32_t>(levels_.size()); level-- > 1;)
        for (std::uint32_t i = 0; i < levels_[level].count; ++i)
            set(level - 1, i, bounds_of_node(nodes_[levels_[level].first + i]));
}

}  // namespace plumb
