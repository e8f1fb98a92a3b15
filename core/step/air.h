// SPDX-License-Identifier: MIT
/// The drag of the air on surfaces that deform.
///
/// The force on a triangle is that on its corners, each with a third of the area and the air's
/// velocity relative to the corner. A particle then feels nothing but its own velocity, which makes
/// the implicit step exact about the one thing that matters: no particle is ever made faster,
/// relative to the air, than it was.
#pragma once

#include "constraints/air_drag.h"
#include "schedule/workers.h"
#include "world/world.h"

#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

class Air {
public:
    Air() = default;
    /// Takes the surfaces of a world that the air drags at.
    explicit Air(const World& world);

    /// Changes the velocities of particles by what the air does in h [s].
    void blow(World& world, Workers& workers, double h);

private:
    struct Triangle {
        std::array<std::uint32_t, 3> corners;  ///< particles
        AirCoefficients coefficients;
    };

    std::vector<Triangle> triangles_;
    std::vector<Vector3d> thirds_;          ///< [triangle] area times normal, of a corner [m²]
    std::vector<std::uint32_t> particles_;  ///< those that are corners
    std::vector<std::uint32_t> first_;      ///< [particle of particles_] where its triangles begin
    std::vector<std::uint32_t> around_;     ///< triangles, particle by particle
};

}  // namespace plumb
