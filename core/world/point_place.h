// SPDX-License-Identifier: MIT
/// Where a point of the world, of a body or of a particle is.
#pragma once

#include "world/world.h"

namespace plumb {

/// World frame [m].
inline Vector3d place_of(const World& world, const WorldPoint& p) {
    if (p.particle != kNoIndex) return world.particles.position[p.particle];
    return p.body == kNoIndex ? p.position : in_world(world.bodies, p.body, p.position);
}

}  // namespace plumb
