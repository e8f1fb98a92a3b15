// SPDX-License-Identifier: MIT
/// A box along the axes of a frame.
#pragma once

#include "manifold/linear.h"

namespace plumb {

struct Aabb {
    Vec3 low, high;  ///< [m]
};

/// Holds nothing, and overlaps nothing.
inline constexpr Aabb kNothing{{kInfinity, kInfinity, kInfinity},
                               {-kInfinity, -kInfinity, -kInfinity}};
inline bool is_nothing(const Aabb& box) { return box.low.x > box.high.x; }

/// Without a branch: what is asked of many boxes can be told of none beforehand.
inline bool overlap(const Aabb& a, const Aabb& b) {
    const bool x = (a.low.x <= b.high.x) & (b.low.x <= a.high.x),
               y = (a.low.y <= b.high.y) & (b.low.y <= a.high.y),
               z = (a.low.z <= b.high.z) & (b.low.z <= a.high.z);
    return x & y & z;
}

}  // namespace plumb
