// SPDX-License-Identifier: MIT
#include "measure/deformation.h"

#include "constraints/volume.h"

#include <cmath>

namespace plumb {
namespace {

/// Squares of the elongations of some elements' edges.
struct Squares {
    double sum = 0, count = 0;

    template <std::size_t N>
    void add(const World& world, const Deformable& d,
             const std::vector<std::array<std::uint32_t, N>>& elements) {
        const Vector3d* now = world.particles.position.data() + d.first;
        for (const auto& e : elements)
            for (std::size_t i = 0; i < N; ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    const double rest = (d.spec.points[e[i]] - d.spec.points[e[j]]).norm();
                    const double strain = (now[e[i]] - now[e[j]]).norm() / rest - 1;
                    sum += strain * strain, ++count;
                }
    }
};

}  // namespace

Vector3d centre_of(const World& world, const Deformable& d) {
    Vector3d sum = Vector3d::Zero();
    double mass = 0;
    for (std::uint32_t i = d.first; i < d.first + d.count; ++i) {
        sum += world.particles.mass[i] * world.particles.position[i];
        mass += world.particles.mass[i];
    }
    return sum / mass;
}

std::vector<double> strains(const World& world) {
    std::vector<double> all;
    for (const Deformable& d : world.deformables) {
        Squares squares;
        if (d.spec.kind == DeformableKind::rope)
            squares.add(world, d, d.spec.segments);
        else if (d.spec.kind == DeformableKind::solid)
            squares.add(world, d, d.spec.tetrahedra);
        else
            squares.add(world, d, d.spec.triangles);
        all.push_back(squares.count > 0 ? std::sqrt(squares.sum / squares.count) : 0);
    }
    return all;
}

double volume_inside(const World& world, const Deformable& d) {
    const Vector3d* points = world.particles.position.data() + d.first;
    return volume_of(d.spec.triangles,
                     [&](std::uint32_t i) -> Vector3d { return points[i] - points[0]; });
}

std::vector<double> volume_errors(const World& world) {
    std::vector<double> errors;
    for (const Deformable& d : world.deformables) {
        if (d.spec.kind != DeformableKind::balloon || d.spec.pressure) continue;
        errors.push_back(volume_inside(world, d) / kept_volume(d.spec) - 1);
    }
    return errors;
}

}  // namespace plumb
