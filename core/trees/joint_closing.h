// SPDX-License-Identifier: MIT
/// Closes a joint by the pose of one of its bodies, the other being where it is to be.
#pragma once

#include "world/world.h"

#include <cstdint>

namespace plumb {

/// Turns body `moved` about its centre of mass by the least angle after which it is turned against
/// the other no more than the joint lets it, then takes it to where their points meet along what
/// the joint locks. Its rate turns with it, which keeps its energy. What gives way (compliance)
/// stays as it is.
void close_joint(Bodies& bodies, const Joint& joint, std::uint32_t moved);

}  // namespace plumb
