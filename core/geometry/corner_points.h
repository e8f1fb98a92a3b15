// SPDX-License-Identifier: MIT
/// The points of a shape that pass between particles where nothing else notices.
#pragma once

#include <plumb/shape.h>

#include "math/types.h"

#include <vector>

namespace plumb {

/// A ball on a shape's surface or its core.
struct CornerPoint {
    Vector3d position;  ///< in the geometry's frame [m]
    double radius = 0;  ///< [m]
};

/// Corners of boxes, hulls and meshes, rims of cylinders and cones, and the cores of round shapes;
/// none of planes and height fields, whose particles meet them anyway.
std::vector<CornerPoint> corner_points(const Shape& shape);

}  // namespace plumb
