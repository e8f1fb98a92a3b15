// SPDX-License-Identifier: MIT
/// Points near surfaces that deform: particles, and the corners and rims of bodies. They stay until
/// the next step finds its own, which learns from them on which side each point was.
#pragma once

#include "math/types.h"
#include "world/links.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

/// A point that is to stay on one side of a triangle of particles.
struct SurfaceContact {
    WorldPoint point;                       ///< of a particle or a body
    std::array<std::uint32_t, 3> triangle;  ///< particles
    std::array<double, 3> weights;          ///< of the triangle's point that is nearest
    Vector3d normal;                        ///< unit, out of the surface towards the point
    double distance;                        ///< to keep along the normal [m]
    double friction;                        ///< Coulomb's coefficient
    std::int8_t side = 0;  ///< of an open surface on which the point belongs: 1 where the corners
                           ///< turn to the left, −1 on the other one, 0 where nothing tells
};

}  // namespace plumb
