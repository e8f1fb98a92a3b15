// SPDX-License-Identifier: MIT
/// The volumes of balloons in the elastic system: kept by a stiff filling, or blown up by a given
/// pressure.
///
/// The pressure that keeps a volume is an unknown of its own, for it acts on all particles of its
/// balloon: a row of the system.
#pragma once

#include "constraints/volume.h"
#include "solve/elements.h"

#include <vector>

namespace plumb {

class Balloons {
public:
    explicit Balloons(const World& world);

    /// Rows of kept volumes, and the pairs (particle, row) that have blocks.
    std::uint32_t rows() const { return rows_; }
    void add_pairs(std::uint32_t first_row, std::vector<SparseLdlt::Pair>& pairs) const;

    /// Adds −∇E at the places to the forces of the particles [N], and E to the energy [J].
    void add_forces(const ParticlePlaces& x, std::vector<Vector3d>& force, double& energy);

    /// Second derivatives there, for a substep of h [s]. `mass`: [particle], 0 of what stays.
    void add_stiffness(const ParticlePlaces& x, const std::vector<double>& mass, double h,
                       std::uint32_t first_row, SparseLdlt& system);

private:
    struct Balloon {
        const Triangles* triangles;
        std::uint32_t first, count;      ///< particles
        double volume;                   ///< to be kept [m³]
        double pressure;                 ///< given [Pa]
        double stiffness;                ///< of a kept volume [Pa/m³]
        std::vector<Vector3d> gradient;  ///< of the volume where it was measured last [m²]

        bool keeps_volume() const { return stiffness > 0; }
    };
    static double measure(Balloon& balloon, const ParticlePlaces& x);

    std::vector<Balloon> balloons_;
    std::uint32_t rows_ = 0;
};

}  // namespace plumb
