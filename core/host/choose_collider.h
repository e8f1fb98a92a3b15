// SPDX-License-Identifier: MIT
/// Which collider a scene gets when none is named, and why.
#pragma once

#include "host/load_plugin.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumb {

struct ColliderChoice {
    const ColliderInfo* collider = nullptr;  ///< nullptr: none supports every pair of the scene
    std::string reason;  ///< "supports all 3 pairs of shapes, about 0.72 of bullet's cost"
};

/// Takes, of the plugins that support every pair of shapes of the scene, the one whose table makes
/// it cheapest: the sum over the pairs of kinds of PluginTable::costs, each times how many such
/// pairs are near each other (ShapePairNeed::near). Nothing is measured, so the choice is the same
/// on every machine. The order:
///
///  1. plugins that compute in double precision before those in single: a choice must not cost
///     accuracy;
///  2. those whose costs of all these pairs are known before those that leave one at 0;
///  3. the cheaper, and where costs are equal or unknown, by name.
///
/// "reference" is taken only where no other plugin can, whatever it costs: it is the yardstick that
/// the others are held against, and its broad phase, a sweep along one axis, loses to trees and
/// grids in large scenes, which costs of single pairs do not show.
ColliderChoice choose_collider(const std::vector<ColliderInfo>& colliders, const Scene& scene);

}  // namespace plumb
