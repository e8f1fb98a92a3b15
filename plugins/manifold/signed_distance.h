// SPDX-License-Identifier: MIT
/// Signed distance of a point to the surface of a part, with the surface's nearest point and its
/// outward normal there.
///
/// Closed forms for round shapes and boxes, faces for hulls, triangles for meshes and height
/// fields. The distance is negative inside. What counts as inside:
///   plane, height field  below the surface; a height field has no walls, so a point beside its
///   grid
///                        is never inside
///   closed mesh          what its triangles enclose
///   open mesh            nothing: it is a sheet with two sides, and the normal points to the
///                        point's own
#pragma once

#include "manifold/body_table.h"

namespace plumb {

struct SurfacePoint {
    double distance = 0;         ///< [m], negative inside
    Vec3 normal{};               ///< unit, outward, world frame
    Vec3 point{};                ///< of the surface, world frame [m]
    std::uint32_t triangle = 0;  ///< of a mesh or a height field, as the shape numbers it; else 0
};

/// False where the surface is farther than `within` [m] (only shapes of triangles look that far and
/// no farther), or where there is no answer.
bool signed_distance(SurfacePoint& result, const Part& part, Vec3 point, double within);

/// Whether a point lies inside, and not on the surface.
bool holds_point(const Part& part, Vec3 point);

}  // namespace plumb
