// SPDX-License-Identifier: MIT
/// How finely a mesh stands for a smooth surface.
#pragma once

#include <plumb/shape.h>

namespace plumb {

struct MeshResolution {
    double sagitta = 0;       ///< how far the smooth surface bulges over the facets [m]
    double longest_edge = 0;  ///< [m]
};

/// Of a mesh, or of the coarsest mesh among a compound's parts; zeros for shapes without
/// triangles.
///
/// What the user's surface was is not known, so the sagitta is an estimate: across each edge whose
/// triangles bend by an angle θ of at most 60°, an arc through both has a sagitta of c/2·tan(θ/4),
/// where c is the mean height of the two triangles over the edge. A sharper edge is taken for an
/// edge of the shape itself. A surface may bend in two directions at once, so twice the largest
/// counts. A flat mesh, or one of sharp edges alone, has sagitta 0.
MeshResolution mesh_resolution(const Shape& shape);

}  // namespace plumb
