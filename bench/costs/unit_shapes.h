// SPDX-License-Identifier: MIT
/// Shapes that are about 1 m across; their memory lives until the end of the process.
#pragma once

#include <plumb/shape.h>

namespace plumb::bench {

/// A shape that may be the upper one of a pair: it reaches from −0.5 to +0.5 m along y. A hull is a
/// prism of six sides, a mesh a closed cube of 192 triangles.
Shape unit_shape(ShapeKind kind);

/// A shape to stand on with its surface at y = 0: a patch of 2 m × 2 m of 4 × 4 cells for meshes
/// and height fields, the half-space for planes.
Shape unit_ground(ShapeKind kind);

}  // namespace plumb::bench
