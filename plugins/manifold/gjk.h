// SPDX-License-Identifier: MIT
/// Closest points of two convex parts that are apart (Gilbert, Johnson and Keerthi), for back-ends
/// that answer nothing until shapes overlap.
#pragma once

#include "manifold/manifold.h"

namespace plumb {

/// The witness of two separated parts, a before b. Returns false where the cores overlap or come
/// closer than about 1e-9 of their size. Neither part may be a plane or a mesh. `way` is where the
/// search begins, out of b towards a; zero: from middle to middle.
bool closest_when_apart(Witness& witness, const Part& a, const Part& b, Vec3 way = {});

/// The same where parts touch or overlap a little: asks about both shrunk by a fiftieth, which
/// keeps the direction of faces and edges, and so mostly the normal; the gap is then measured on
/// the true shapes.
bool closest_when_touching(Witness& witness, const Part& a, const Part& b);

/// The point where two parts touch that overlap along the unit normal n by −gap: both are drawn
/// apart along n before they are asked. False where that finds none.
bool touching_point(Vec3& point, const Part& a, const Part& b, Vec3 n, double gap);

/// Turns the unit normal of two parts that touch or overlap a little to where their support gap is
/// greatest nearby: to the way between their closest points once a is drawn away along it, over and
/// over. A normal off by an angle is then off by that angle times how far they were drawn apart
/// over their radius of curvature. False where that leads nowhere.
bool straighten(Vec3& normal, const Part& a, const Part& b);

}  // namespace plumb
