// SPDX-License-Identifier: MIT
/// The order in which the bodies of trees are visited: level by level, and in a level so that no
/// two bodies that are visited together have one parent.
#pragma once

#include "schedule/joint_forest.h"

#include <vector>

namespace plumb {

/// Nodes of one level, visited together.
struct TreeGroup {
    std::vector<std::uint32_t> nodes;
    bool side_by_side;
    bool first;   ///< on the way from the leaves, they come before their parents' other children
    bool leaves;  ///< they have no children
};

/// Roots first; the way from the leaves is the reverse. `side_by_side` [node].
std::vector<TreeGroup> find_tree_groups(const JointForest& forest,
                                        const std::vector<std::uint8_t>& side_by_side);

}  // namespace plumb
