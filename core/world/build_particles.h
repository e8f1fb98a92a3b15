// SPDX-License-Identifier: MIT
/// From deformables to particles: places, and masses lumped to the points.
#pragma once

#include "scene/scene.h"
#include "world/world.h"

namespace plumb {

/// Makes the particles of a scene, one deformable after another. Throws SceneError, with the place
/// of the deformable and its element, for what cannot be simulated: numbers out of range, points
/// that there are none of, elements without extent, solids turned inside out, a balloon that is
/// open.
void build_particles(World& world, const Scene& scene);

}  // namespace plumb
