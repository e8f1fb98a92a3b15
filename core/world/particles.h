// SPDX-License-Identifier: MIT
/// The particles' state as tables, one column a quantity, indexed by particle.
#pragma once

#include "math/types.h"

#include <cstdint>
#include <vector>

namespace plumb {

struct Particles {
    std::vector<Vector3d> position;          ///< [m]
    std::vector<Vector3d> velocity;          ///< [m/s]
    std::vector<double> mass, inverse_mass;  ///< [kg], [1/kg]; an inverse of 0 stays where it is
    std::vector<double> radius;              ///< [m]
    std::vector<std::uint32_t> material;
    std::vector<std::uint32_t> deformable;  ///< of which it is a point

    std::vector<Vector3d> velocity_now;  ///< at the start of the substep, without its forces [m/s]

    std::size_t size() const { return position.size(); }
};

/// What a deformable has of the particles: [first, first + count), and what they may touch.
struct Deformable {
    std::uint32_t first = 0, count = 0;
    std::uint32_t group = 1, mask = ~0u;
};

}  // namespace plumb
