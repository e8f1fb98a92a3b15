// SPDX-License-Identifier: MIT
/// The trees that a world's joints form.
#pragma once

#include "schedule/joint_forest.h"
#include "world/world.h"

#include <algorithm>
#include <vector>

namespace plumb {

/// A joint's bodies as rows of the velocity table, and how many rows it takes away.
inline BodyPair joined_pair(const World& world, std::uint32_t index) {
    const Joint& joint = world.joints.joints[index];
    const auto row_of = [&](std::uint32_t body) {
        return body == kNoIndex ? world.zero_row() : world.bodies.row[body];
    };
    const auto rows = std::count(joint.locked.begin(), joint.locked.end(), true);
    return {row_of(joint.a), row_of(joint.b), index,
            joint.broken ? 0 : static_cast<std::uint32_t>(rows)};
}

inline JointForest find_forest(const World& world) {
    std::vector<BodyPair> pairs;
    for (std::uint32_t i = 0; i < world.joints.size(); ++i) pairs.push_back(joined_pair(world, i));
    return grow_joint_forest(pairs, world.dynamic_count);
}

}  // namespace plumb
