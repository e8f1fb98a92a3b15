// SPDX-License-Identifier: MIT
/// Which pairs of shape kinds a scene may bring together, and about how often.
#pragma once

#include <plumb/plugin.h>

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumb {

struct ShapePairNeed {
    ShapeKind a, b;
    bool moving_mesh;     ///< a mesh of the pair belongs to a body that moves
    double near;          ///< about how many such pairs are near each other at a time
    std::string example;  ///< "body \"crate\" and body \"floor\""
};

/// Each pair of kinds once, or twice where meshes of it move and others rest. Compounds count as
/// their parts; pairs that filters keep apart do not count.
///
/// How many are near each other is estimated from the numbers of parts alone, as if all lay in one
/// well-mixed heap: a part of a dynamic body stands on one surface (plane, mesh, height field) and
/// has six other neighbours, or as many as it can meet, each drawn from all that it can meet. So
/// the count grows with the number of parts and not with its square, as in a heap it does.
std::vector<ShapePairNeed> shape_pair_needs(const Scene& scene);

/// Whether a plugin's table claims what the scene needs of a pair.
bool supports(const PluginTable& table, const ShapePairNeed& need);

}  // namespace plumb
