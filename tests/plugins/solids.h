// SPDX-License-Identifier: MIT
/// Shapes with what the tests know of them apart from any collider: which points are inside, and
/// many points of the surface.
#pragma once

#include "dice.h"
#include "harness.h"

#include <functional>

namespace plumb::test {

struct Solid {
    const char* name;
    Shape shape;
    std::function<bool(const V&)> inside;  ///< in the shape's frame
    std::vector<V> surface;                ///< dense samples, in the shape's frame
    double spacing;                        ///< no point of the surface is farther from a sample [m]
};

/// One solid of every bounded convex kind and a torus mesh; those that the plugin takes.
std::vector<Solid> solids_of(const std::string& plugin);

/// How often a mesh winds around a point: 1 inside, 0 outside.
double winding(const Shape& mesh, const V& p);

}  // namespace plumb::test
