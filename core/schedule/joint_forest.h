// SPDX-License-Identifier: MIT
/// Trees of bodies linked by joints.
///
/// How deep each joint hangs: joints to immovable bodies first, then those of the bodies that they
/// hold, and so on. Swept level by level, up and down in turn, a tree's impulses travel its whole
/// depth in one iteration. And which joints make up trees, with an order of elimination, so that
/// these can be solved exactly.
#pragma once

#include "schedule/colouring.h"

namespace plumb {

/// Sets the level of each pair to the depth of the nearer of its bodies. Where nothing is held, the
/// body of the lowest row is the root.
void find_joint_levels(std::vector<BodyPair>& joints, std::int32_t dynamic_count);

/// A dynamic body of a tree, and the joint that it hangs by.
struct ForestNode {
    std::int32_t row;     ///< of the body in the velocity table
    std::int32_t parent;  ///< node; kHeld: an immovable body, kFree: there is no joint
    std::uint32_t joint;  ///< index among the joints; none of a free root
};
inline constexpr std::int32_t kHeld = -1, kFree = -2;

struct JointForest {
    std::vector<ForestNode> nodes;      ///< parents before their children
    std::vector<std::uint8_t> in_tree;  ///< [joint] 1: an edge of a tree
    std::uint32_t edges = 0;            ///< joints that are edges
    std::uint32_t loops = 0;            ///< joints that close a loop instead
};

/// Grows trees breadth first, from immovable bodies and then from the bodies of the lowest rows.
/// Immovable bodies are one ground, so that a second joint to them closes a loop. Joints without
/// rows (BodyPair::count = 0) link nothing.
JointForest grow_joint_forest(const std::vector<BodyPair>& joints, std::int32_t dynamic_count);

/// [node] how many joints are between it and the root of its tree.
std::vector<std::uint32_t> depths_of(const JointForest& forest);

/// Whether there is hardly more than one body to a level, as in a chain: what is solved level by
/// level gains nothing from lanes there.
bool is_narrow(const JointForest& forest);

/// Shares out whole trees into at most `parts` forests of about the same size; of each only `nodes`
/// is filled.
std::vector<JointForest> share_out_trees(const JointForest& forest, std::uint32_t parts);

}  // namespace plumb
