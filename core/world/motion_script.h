// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.h"

namespace plumb {

/// Where a kinematic body is at a time [s]: between two keyframes its position is linear and its
/// rotation turns evenly. The script has a keyframe.
Placement placement_at(const MotionScript& script, double time);

}  // namespace plumb
