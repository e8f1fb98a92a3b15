// SPDX-License-Identifier: MIT
/// From links and attachments of a scene to those of the world.
#pragma once

#include "scene/scene.h"
#include "world/world.h"

namespace plumb {

/// After bodies and particles were made. Points attached to the world, or to a body that is fixed,
/// without compliance become immovable. Throws SceneError for points that there are not.
void build_links(World& world, const Scene& scene);

}  // namespace plumb
