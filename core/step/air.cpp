// SPDX-License-Identifier: MIT
#include "step/air.h"

#include "scene/wind.h"

#include <algorithm>
#include <utility>

namespace plumb {

Air::Air(const World& world) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;  // particle, triangle
    for (const Deformable& d : world.deformables) {
        const bool is_closed = d.spec.kind != DeformableKind::cloth;
        const AirCoefficients coefficients =
            air_coefficients(world.settings.air_density, d.spec.drag, d.spec.skin_drag, is_closed);
        if (!(coefficients.pressure + coefficients.friction > 0)) continue;
        for (const auto& t : d.spec.triangles) {
            const auto index = static_cast<std::uint32_t>(triangles_.size());
            triangles_.push_back({{d.first + t[0], d.first + t[1], d.first + t[2]}, coefficients});
            for (const std::uint32_t p : triangles_.back().corners)
                if (world.particles.inverse_mass[p] > 0) corners.emplace_back(p, index);
        }
    }
    thirds_.resize(triangles_.size());
    std::sort(corners.begin(), corners.end());
    for (const auto& [particle, triangle] : corners) {
        if (particles_.empty() || particles_.back() != particle) {
            particles_.push_back(particle);
            first_.push_back(static_cast<std::uint32_t>(around_.size()));
        }
        around_.push_back(triangle);
    }
    first_.push_back(static_cast<std::uint32_t>(around_.size()));
}

void Air::blow(World& world, Workers& workers, double h) {
    Particles& p = world.particles;
    const Vector3d wind = wind_at(world.settings, world.time);
    workers.run([&](std::uint32_t worker) {
        const Range some = workers.share(static_cast<std::uint32_t>(triangles_.size()), worker);
        for (std::uint32_t i = some.first; i < some.last; ++i) {
            const auto& [a, b, c] = triangles_[i].corners;
            thirds_[i] = (p.position[b] - p.position[a]).cross(p.position[c] - p.position[a]) / 6;
        }
        workers.barrier();
        const Range mine = workers.share(static_cast<std::uint32_t>(particles_.size()), worker);
        for (std::uint32_t i = mine.first; i < mine.last; ++i) {
            const std::uint32_t particle = particles_[i];
            const Vector3d w = wind - p.velocity[particle];
            Matrix3d resistance = Matrix3d::Zero();
            for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k)
                resistance +=
                    air_resistance(triangles_[around_[k]].coefficients, thirds_[around_[k]], w);
            p.velocity[particle] = wind - dragged(w, resistance, p.mass[particle], h);
        }
    });
}

}  // namespace plumb
