// SPDX-License-Identifier: MIT
#pragma once

#include "world/world.h"

namespace plumb {

/// Adds the scene's joints and couplings to a world that has its bodies. Throws SceneError, with a
/// JSON pointer, for what cannot be simulated.
void build_joints(World& world, const Scene& scene);

}  // namespace plumb
