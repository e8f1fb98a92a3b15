// SPDX-License-Identifier: MIT
/// The trees that a world's joints form.
#pragma once

#include "schedule/joint_forest.h"
#include "world/world.h"

namespace plumb {

/// The forest of the joints that are to be solved exactly. With JointMethod::auto_, bodies that
/// hang together are left out where they are mostly coupled, where more than one joint in ten
/// closes a loop, or where they are a passive ragdoll: few, held by nothing, driven but by
/// no motor. `asleep_too`: as if all were awake, with rows of its own.
JointForest find_forest(const World& world, bool asleep_too = false);

/// Whether bodies have so many couplings that a tree of their joints is not most of what holds
/// them: of gears all are coupled, a gripper on an arm has one coupling.
constexpr bool is_mostly_coupled(std::size_t couplings, std::size_t joints) {
    return 5 * couplings > joints;
}

}  // namespace plumb
