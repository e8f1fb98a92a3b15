// SPDX-License-Identifier: MIT
#include "schedule/tree_levels.h"

#include <map>
#include <tuple>

namespace plumb {

std::vector<TreeGroup> find_tree_groups(const JointForest& forest,
                                        const std::vector<std::uint8_t>& side_by_side) {
    const std::size_t count = forest.nodes.size();
    const std::vector<std::uint32_t> depth = depths_of(forest);
    std::vector<std::uint32_t> children(count, 0);
    std::vector<std::int64_t> later(count, 0);  // children of the same parent that come after
    for (std::size_t i = count; i-- > 0;) {
        const std::int32_t parent = forest.nodes[i].parent;
        if (parent >= 0) later[i] = children[parent]++;
    }
    std::map<std::tuple<std::uint32_t, std::int64_t, bool, bool>, TreeGroup> groups;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool together = side_by_side[i], leaf = children[i] == 0;
        TreeGroup& group = groups[{depth[i], -later[i], together, leaf}];
        group.nodes.push_back(i);
        group.side_by_side = together, group.first = later[i] == 0, group.leaves = leaf;
    }
    std::vector<TreeGroup> sorted;
    for (auto& [key, group] : groups) sorted.push_back(std::move(group));
    return sorted;
}

}  // namespace plumb
