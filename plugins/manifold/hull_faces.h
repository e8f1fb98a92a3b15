// SPDX-License-Identifier: MIT
/// The faces of a convex hull, made ready: triangles of one plane merged into one polygon.
#pragma once

#include "manifold/linear.h"

#include <cstdint>
#include <vector>

namespace plumb {

struct HullFace {
    Vec3 normal;                         ///< unit, outward, shape frame
    std::vector<std::uint32_t> corners;  ///< vertex indices, counter-clockwise seen from outside
};

/// Faces of a hull in the order in which the user named them; of faces in one plane the first
/// stands for all.
std::vector<HullFace> merged_faces(const Shape& hull);

}  // namespace plumb
