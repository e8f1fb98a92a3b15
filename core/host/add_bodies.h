// SPDX-License-Identifier: MIT
/// A scene's shapes, handed to a collider.
#pragma once

#include <plumb/proximity.h>

#include "scene/scene.h"
#include "world/world.h"

#include <string>

namespace plumb {

/// Adds every body that has a shape, under its index, and excludes the pairs that joints link.
/// The world's shapes must outlive the collider's use of them. Throws ColliderError with what the
/// collider, called `collider`, refused.
void add_bodies(Proximity& proximity, const World& world, const Scene& scene,
                const std::string& collider);

}  // namespace plumb
