// SPDX-License-Identifier: MIT
/// Exact answers of convex shapes, from their support functions: code of the tests alone.
///
/// Along a unit normal n the support gap of two shapes is
///
///     g(n) = min over a of n·x − max over b of n·x
///
/// and the signed gap of the shapes is the greatest g: their distance when apart, minus the least
/// shift that parts them when they overlap. So any n proves a lower bound, and a contact whose own
/// normal yields its gap is never too large.
#pragma once

#include "shapes.h"

#include <vector>

namespace plumb::test {

/// The farthest point of a convex shape along a direction [m]. Not for planes.
V support(const Shape& shape, const Place& place, const V& way);

/// g(n), planes included: for them n must be their own normal, or the answer is minus infinity.
double support_gap(const Shape& a, const Place& pa, const Shape& b, const Place& pb, const V& n);

/// How far a point lies outside of a convex shape, or a bound below that [m]; negative inside.
double outside(const Shape& shape, const Place& place, const V& point);

/// The greatest support gap.
struct Widest {
    V n = V::UnitY();        ///< out of b towards a
    double gap = -1e300;     ///< [m]
    double second = -1e300;  ///< the best axis that points elsewhere (by more than a degree) [m]
};

/// Boxes and hulls: all faces of both, and all pairs of edges. Exact where they overlap.
Widest separating_axes(const Shape& a, const Place& pa, const Shape& b, const Place& pb);

/// Any convex kinds, by search over the sphere: never too large.
Widest widest_gap(const Shape& a, const Place& pa, const Shape& b, const Place& pb);

}  // namespace plumb::test
