// SPDX-License-Identifier: MIT
/// From links and attachments of a scene to those of the world.
#pragma once

#include "scene/scene.h"
#include "world/world.h"

namespace plumb {

/// Whether a link is a distance joint: rigid, and between bodies. Trees of joints know more of such
/// than links do: how bodies turn at its ends within a substep, and what heavy loads do to light
/// ones. These joints have the identifiers after those of the scene's, in the order of the links.
bool is_rod(const Scene& scene, const LinkSpec& link);

/// After bodies and particles were made. Points attached to the world, or to a body that is fixed,
/// without compliance become immovable. Throws SceneError for points that there are not.
void build_links(World& world, const Scene& scene);

}  // namespace plumb
