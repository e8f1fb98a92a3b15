// SPDX-License-Identifier: MIT
/// The volume inside of a closed surface: C = V − k V₀ among all its points at once (Müller et al.
/// 2007, §4.4). The pressure's resultant, the sum of all gradients, is 0 as long as the surface is
/// closed.
#pragma once

#include "math/types.h"
#include "scene/deformable.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// V [m³], with ∂V/∂p of each point added to `gradient` [m²]. `place(i)`: of point i [m], against
/// any point near the surface.
template <class Place>
inline double volume_of(const Triangles& triangles, Place place,
                        std::vector<Vector3d>* gradient = nullptr) {
    double volume = 0;
    for (const auto& t : triangles) {
        const Vector3d a = place(t[0]), b = place(t[1]), c = place(t[2]);
        const Vector3d bc = b.cross(c);
        volume += a.dot(bc) / 6;
        if (!gradient) continue;
        (*gradient)[t[0]] += bc / 6;
        (*gradient)[t[1]] += c.cross(a) / 6;
        (*gradient)[t[2]] += a.cross(b) / 6;
    }
    return volume;
}

/// k V₀ of a balloon [m³].
inline double kept_volume(const DeformableSpec& balloon) {
    const std::vector<Vector3d>& points = balloon.points;
    return balloon.volume_ratio * volume_of(balloon.triangles, [&](std::uint32_t i) -> Vector3d {
               return points[i] - points[0];
           });
}

}  // namespace plumb
