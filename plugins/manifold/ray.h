// SPDX-License-Identifier: MIT
/// Where a ray first meets a part.
///
/// A ray that begins inside a solid hits it at once: distance 0, and the normal looks back along
/// the ray. Open meshes have no inside and are hit from both sides; their normal looks to the side
/// that the ray comes from.
#pragma once

#include "manifold/body_table.h"

namespace plumb {

struct PartHit {
    double distance = 0;         ///< along the ray [m]
    Vec3 normal{};               ///< of the surface, unit, world frame
    std::uint32_t triangle = 0;  ///< of a mesh or a height field; else 0
};

/// False where the ray, in the world frame, misses the part or meets it beyond `length` [m].
bool cast_ray(PartHit& hit, const Part& part, const Ray& ray, double length);

}  // namespace plumb
