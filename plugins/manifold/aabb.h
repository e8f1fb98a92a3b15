// SPDX-License-Identifier: MIT
/// A box along the axes of a frame.
#pragma once

#include "manifold/linear.h"

namespace plumb {

struct Aabb {
    Vec3 low, high;  ///< [m]
};
inline bool overlap(const Aabb& a, const Aabb& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
           b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace plumb
