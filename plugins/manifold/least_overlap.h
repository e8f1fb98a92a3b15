// SPDX-License-Identifier: MIT
/// The last resort for parts whose middles nearly coincide, where every other search for a
/// direction ends somewhere.
#pragma once

#include "manifold/manifold.h"

namespace plumb {

/// The direction along which two convex parts overlap least: a search over the sphere that begins
/// at the axes, edges and corners of both frames. Its overlap is never less than the true one, and
/// seldom more. For a ball and a shape of a closed form it is exact.
Witness least_overlap(const Part& a, const Part& b);

/// Whether an axis of one of the frames parts two convex parts by more than a distance [m].
bool axes_part(const Part& a, const Part& b, double by = 0);

}  // namespace plumb
