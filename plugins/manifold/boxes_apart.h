// SPDX-License-Identifier: MIT
/// Boxes that a face parts: most of those whose bounds overlap, and told by a few products.
#pragma once

#include "manifold/body_table.h"

namespace plumb {

/// Whether an axis of a face parts two boxes by more than a distance [m], and by so much more that
/// no other way to measure them finds less.
inline bool faces_part_boxes(const Part& a, const Part& b, double by) {
    constexpr double kMore = 1e-6;  // of their sizes
    const Vec3 &half_a = a.shape.half_extents, &half_b = b.shape.half_extents;
    const double sizes = half_a.x + half_a.y + half_a.z + half_b.x + half_b.y + half_b.z;
    const double enough = by + kMore * sizes;
    const Vec3 way = b.world.origin - a.world.origin;
    Vec3 reach{};  // of a along the axes of b
    for (int i = 0; i < 3; ++i) {
        const Vec3 turned = turned_back(b.world, a.world.axis[i]);
        const Vec3 share{std::abs(turned.x), std::abs(turned.y), std::abs(turned.z)};
        const double apart = std::abs(dot(a.world.axis[i], way)) - at(half_a, i);
        if (apart - dot(share, half_b) > enough) return true;
        reach = reach + at(half_a, i) * share;
    }
    for (int i = 0; i < 3; ++i) {
        const double apart = std::abs(dot(b.world.axis[i], way)) - at(half_b, i);
        if (apart - at(reach, i) > enough) return true;
    }
    return false;
}

}  // namespace plumb
