// SPDX-License-Identifier: MIT
/// How far the true shapes reach along a direction: what judges an axis of separation without any
/// collider's help.
#pragma once

#include <plumb/shape.h>

#include "math/types.h"

#include <cstdint>

namespace plumb {

/// A shape and where it is in the world.
struct PlacedShape {
    const Shape* shape;
    Vector3d origin;  ///< of the shape's frame [m]
    Quaterniond rotation;
};

/// Part `index` of a body: of its compound, or the body's only shape where it is none. `local`
/// takes the body's shape frame into the body's frame.
PlacedShape placed_part(const Shape& shape, const Pose& local, const Pose& body,
                        std::uint32_t index);

/// Whether axes judge it: all but meshes, height fields and compounds.
bool is_convex(ShapeKind kind);

/// Whether a shape, or a part of it, is a mesh or a height field.
bool has_triangles(const Shape& shape);

/// How far a shape reaches along the unit vector d, from the world's origin [m]; infinite for a
/// plane along all but its normal, and for height fields and compounds.
double support(const PlacedShape& shape, const Vector3d& d);

/// Radius of a ball about the origin of a shape's frame that the shape holds [m]; −∞ where none is
/// known of, for the origin of what has vertices may lie outside.
double inner_radius(const Shape& shape);

/// Signed gap of two convex shapes along the unit vector n, which points out of b towards a [m]:
/// the true gap where n is the best axis, and less than it elsewhere. −∞ along any axis of a plane
/// but its own.
double axis_gap(const PlacedShape& a, const PlacedShape& b, const Vector3d& n);

/// Longest side of the box about a shape, along the axes of its frame [m]; infinite for a plane.
double extent_of(const Shape& shape);

}  // namespace plumb
