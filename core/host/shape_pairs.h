// SPDX-License-Identifier: MIT
/// Which pairs of shape kinds a scene may bring together.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumb {

struct ShapePairNeed {
    ShapeKind a, b;
    bool moving_mesh;     ///< a mesh of the pair belongs to a body that moves
    std::string example;  ///< "body \"crate\" and body \"floor\""
};

/// Each pair of kinds once. Compounds count as their parts; pairs that filters keep apart do not
/// count.
std::vector<ShapePairNeed> shape_pair_needs(const Scene& scene);

}  // namespace plumb
