// SPDX-License-Identifier: MIT
/// The last resort for parts whose middles coincide, where every search for a direction ends.
#pragma once

#include "manifold/manifold.h"

namespace plumb {

/// Of all axes of both frames, the one along which two convex parts overlap least.
Witness least_overlap(const Part& a, const Part& b);

}  // namespace plumb
