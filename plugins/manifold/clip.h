// SPDX-License-Identifier: MIT
/// Where two support faces lie over each other, seen along a normal.
#pragma once

#include "manifold/support.h"

namespace plumb {

/// Points that face each other along the normal.
struct FacingPoints {
    static constexpr int kMost = 96;
    struct Point {
        Vec3 on_a, on_b;        ///< on the cores [m]; they differ by a multiple of the normal
        double gap;             ///< between the skins [m]
        std::uint32_t feature;  ///< unique within the two faces
    } point[kMost];
    int count = 0;
    double deepest = 1e300;  ///< least gap [m]

    void add(const Point& p) {
        if (count == kMost) return;
        point[count++] = p;
        deepest = std::min(deepest, p.gap);
    }
};

/// Corners of the common outline of two faces, in order around it. n points out of b towards a.
FacingPoints facing_points(const SupportFace& a, const SupportFace& b, Vec3 n);

}  // namespace plumb
