// SPDX-License-Identifier: MIT
/// The particles' state as tables, one column a quantity, indexed by particle.
#pragma once

#include "math/types.h"
#include "scene/deformable.h"

#include <cmath>
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

    std::size_t size() const { return position.size(); }
};

/// What a deformable has of the particles: [first, first + count).
struct Deformable {
    DeformableSpec spec;  ///< as it is now: without the elements that are torn
    std::uint32_t first = 0, count = 0;
    DeformableSpec whole{};             ///< as it was at the start, where it can tear
    std::vector<std::uint32_t> torn{};  ///< elements of `whole`, sorted: segments of a rope,
                                        ///< triangles of a sheet, tetrahedra of a solid

    bool can_tear() const { return std::isfinite(spec.tearing_strain); }
    const DeformableSpec& at_start() const { return can_tear() ? whole : spec; }
};

/// Cross section of a rope [m²].
inline double rope_section(const DeformableSpec& spec) {
    constexpr double kQuarterPi = 0.7853981633974483;
    return kQuarterPi * spec.thickness * spec.thickness;
}
/// E I of a rope [N m²].
inline double rope_bending_stiffness(const DeformableSpec& spec) {
    return spec.elasticity.bending_stiffness.value_or(
        spec.elasticity.youngs_modulus * rope_section(spec) * spec.thickness * spec.thickness / 16);
}
/// Flexural rigidity of a sheet, E t³ / 12 (1 − ν²) [N m].
inline double cloth_bending_stiffness(const DeformableSpec& spec) {
    const double t = spec.thickness, nu = spec.elasticity.poissons_ratio;
    return spec.elasticity.bending_stiffness.value_or(spec.elasticity.youngs_modulus * t * t * t /
                                                      (12 * (1 - nu * nu)));
}

/// Calls visit({a, b, c}) for each point b of a rope at which two segments meet.
template <class Visit>
inline void each_corner(const DeformableSpec& spec, Visit visit) {
    for (std::size_t i = 0; i < spec.segments.size(); ++i)
        for (std::size_t j = i + 1; j < spec.segments.size(); ++j)
            for (int k = 0; k < 2; ++k)
                for (int l = 0; l < 2; ++l)
                    if (spec.segments[i][k] == spec.segments[j][l])
                        visit(std::array<std::uint32_t, 3>{
                            spec.segments[i][1 - k], spec.segments[i][k], spec.segments[j][1 - l]});
}

}  // namespace plumb
