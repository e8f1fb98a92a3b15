// SPDX-License-Identifier: MIT
/// Whether two shapes overlap: links that do so where a robot starts are not meant to collide.
#pragma once

#include "scene/geometry.h"

namespace plumb {

/// Shapes that overlap by less touch [m].
inline constexpr double kTouching = 1e-4;

/// Whether two shapes overlap by more than `kTouching`. Spheres, boxes, cylinders, hulls and
/// compounds of them; a mesh counts as its convex hull, and every other kind overlaps with nothing.
bool overlap(const Geometry& a, const Placement& at_a, const Geometry& b, const Placement& at_b);

}  // namespace plumb
