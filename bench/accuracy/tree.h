// SPDX-License-Identifier: MIT
/// The joints of a scene as trees, for engines in generalized coordinates.
#pragma once

#include "accuracy/peer.h"

#include <vector>

namespace plumb::bench {

/// A body that hangs by a joint from another, or from the world (kNoIndex).
struct Hanging {
    std::uint32_t body;
    const JointSpec* by;  ///< nullptr: the body is free
    std::uint32_t from;
};

struct Trees {
    std::vector<Hanging> bodies;          ///< dynamic ones, each after the one that it hangs from
    std::vector<const JointSpec*> loops;  ///< joints that close one
};

/// They grow from the world level by level, so that a chain with two ends is cut halfway. Joints
/// that give way do not count.
Trees trees(const Scene& scene, const World& world);

/// Where a joint is at the start, its axis along x [m]. A rod is rigid with its body a: a chain
/// that hangs straight is the same.
inline Placement joint_frame(const JointSpec& joint) {
    return {joint.anchor_b.value_or(joint.anchor), joint.frame};
}

}  // namespace plumb::bench
