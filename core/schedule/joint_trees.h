// SPDX-License-Identifier: MIT
/// The trees that a world's joints form.
#pragma once

#include "schedule/joint_forest.h"
#include "world/world.h"

namespace plumb {

/// The forest of the joints that are to be solved exactly. With JointMethod::auto_, bodies that
/// hang together are left out where a coupling ties two of their joints, where more than one joint
/// in ten closes a loop, or where they are a passive ragdoll: few, held by nothing, driven but by
/// no motor.
JointForest find_forest(const World& world);

}  // namespace plumb
