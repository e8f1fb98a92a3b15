// SPDX-License-Identifier: MIT
/// How deep each joint hangs: joints to immovable bodies first, then those of the bodies that they
/// hold, and so on. Swept level by level, up and down in turn, a tree's impulses travel its whole
/// depth in one iteration.
#pragma once

#include "schedule/colouring.h"

namespace plumb {

/// Sets the level of each pair to the depth of the nearer of its bodies. Where nothing is held, the
/// body of the lowest row is the root.
void find_joint_levels(std::vector<BodyPair>& joints, std::int32_t dynamic_count);

}  // namespace plumb
