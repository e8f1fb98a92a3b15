// SPDX-License-Identifier: MIT
/// One triangle: its point nearest to a point, and where a ray meets it.
#pragma once

#include "manifold/linear.h"

namespace plumb {

/// A point of a triangle, and what of the triangle carries it: a vertex (0…2), an edge (k: from
/// corner k to the next), or with neither its inside.
struct TrianglePoint {
    Vec3 point;  ///< [m]
    int vertex = -1, edge = -1;
};

/// Point of the triangle a, b, c nearest to p. Right for triangles without area too.
TrianglePoint nearest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

/// Distance along a ray to a triangle, border included, from either side [m]; infinite where the
/// ray misses it, begins behind it or runs along it.
double ray_to_triangle(Vec3 origin, Vec3 direction, Vec3 a, Vec3 b, Vec3 c);

}  // namespace plumb
