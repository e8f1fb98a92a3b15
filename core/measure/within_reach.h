// SPDX-License-Identifier: MIT
/// Tells a state that has run off from one that can still be used.
#pragma once

#include "world/world.h"

namespace plumb {

/// Farther than this, or faster, no recording in single precision can tell [m], [m/s], [rad/s].
inline constexpr double kFarthestRecorded = 1e30;

/// Whether all bodies and particles are nearer to the origin, and slower, than `far`.
bool within_reach(const World& world, double far = kFarthestRecorded);

}  // namespace plumb
