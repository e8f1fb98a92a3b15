// SPDX-License-Identifier: MIT
#include "world/build_particles.h"

#include "geometry/outer_faces.h"
#include "scene/deformable_faults.h"
#include "scene/error.h"

#include <cmath>
#include <string>

namespace plumb {
namespace {

/// What a spec's elements share out to their points: [point] the volume that belongs to it [m³].
template <std::size_t N, class Volume>
void share_out(std::vector<double>& volumes,
               const std::vector<std::array<std::uint32_t, N>>& elements, Volume volume) {
    for (const auto& element : elements)
        for (const std::uint32_t point : element)
            volumes[point] += volume(element) / static_cast<double>(N);
}

std::vector<double> point_volumes(const DeformableSpec& spec) {
    const auto& p = spec.points;
    std::vector<double> volumes(p.size(), 0);
    switch (spec.kind) {
        case DeformableKind::rope:
            share_out(volumes, spec.segments, [&](const auto& e) {
                return (p[e[1]] - p[e[0]]).norm() * rope_section(spec);
            });
            break;
        case DeformableKind::cloth:
        case DeformableKind::balloon:
            share_out(volumes, spec.triangles, [&](const auto& e) {
                return 0.5 * (p[e[1]] - p[e[0]]).cross(p[e[2]] - p[e[0]]).norm() * spec.thickness;
            });
            break;
        case DeformableKind::solid:
            share_out(volumes, spec.tetrahedra, [&](const auto& e) {
                return (p[e[1]] - p[e[0]]).cross(p[e[2]] - p[e[0]]).dot(p[e[3]] - p[e[0]]) / 6;
            });
            break;
    }
    return volumes;
}

void add_particles(World& world, const Scene& scene, std::uint32_t index) {
    const DeformableSpec& spec = scene.deformables[index];
    const std::vector<double> volumes = point_volumes(spec);
    double whole = 0;
    for (const double v : volumes) whole += v;
    const double density = spec.mass ? *spec.mass / whole : scene.materials[spec.material].density;
    Particles& to = world.particles;
    for (std::size_t i = 0; i < spec.points.size(); ++i) {
        to.position.push_back(spec.points[i]);
        to.velocity.push_back(spec.velocity);
        to.mass.push_back(density * volumes[i]);
        to.inverse_mass.push_back(1 / to.mass.back());
        to.radius.push_back(spec.radius);
        to.material.push_back(spec.material);
        to.deformable.push_back(index);
    }
}

}  // namespace

void build_particles(World& world, const Scene& scene) {
    for (std::uint32_t i = 0; i < scene.deformables.size(); ++i) {
        const std::string place = "/deformables/" + std::to_string(i);
        if (const auto fault = deformable_fault(scene.deformables[i], scene.materials.size()))
            throw SceneError("", place + fault->place, fault->sentence);
        DeformableSpec spec = scene.deformables[i];
        if (spec.kind == DeformableKind::solid && spec.triangles.empty())
            spec.triangles = outer_faces(spec.tetrahedra);
        Deformable& d = world.deformables.emplace_back();
        d.spec = spec;
        d.first = static_cast<std::uint32_t>(world.particles.size());
        d.count = static_cast<std::uint32_t>(spec.points.size());
        if (d.can_tear()) d.whole = spec;
        add_particles(world, scene, i);
    }
}

}  // namespace plumb
