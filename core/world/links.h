// SPDX-License-Identifier: MIT
/// Links between points of bodies, particles and the world.
#pragma once

#include "math/types.h"
#include "scene/geometry.h"
#include "world/island_rest.h"

#include <cstdint>
#include <vector>

namespace plumb {

/// A point of a particle, of a body, or of the world where it is of neither.
struct WorldPoint {
    std::uint32_t particle = kNoIndex, body = kNoIndex;
    Vector3d position = Vector3d::Zero();  ///< in the body's frame, or the world's [m]
};

/// Two points that stay within a distance of each other; or, where `joins`, at one place.
struct Link {
    WorldPoint a, b;
    bool joins = false;
    double shortest = 0, longest = 0;     ///< [m]
    double compliance = 0, damping = 0;   ///< [m/N], [N s/m]
    Vector3d impulse = Vector3d::Zero();  ///< on a, of the last substep [N s]
    IslandRest island_rest;

    bool is_between_bodies() const {
        return a.particle == kNoIndex && b.particle == kNoIndex && !joins;
    }
    bool is_between_particles() const { return a.particle != kNoIndex && b.particle != kNoIndex; }
};

}  // namespace plumb
