// SPDX-License-Identifier: MIT
/// Balloons: each keeps its volume, or has a pressure.
#pragma once

#include "constraints/volume.h"
#include "schedule/workers.h"
#include "solve/joined_bodies.h"
#include "solve/particle_rows.h"
#include "world/world.h"

#include <vector>

namespace plumb {

template <class Real>
class VolumeGroup {
public:
    VolumeGroup(const World& world, const ParticleMass& mass, Workers& workers)
        : workers_(workers) {
        for (const Deformable& d : world.deformables) {
            if (d.spec.kind != DeformableKind::balloon) continue;
            Balloon balloon;
            balloon.triangles = &d.spec.triangles;
            for (std::uint32_t i = d.first; i < d.first + d.count; ++i) {
                balloon.rows.push_back(world.particle_row(i));
                balloon.inverse_mass.push_back(mass.inverse[i]);
            }
            balloon.pressure = d.spec.pressure.value_or(0);
            balloon.keeps_volume = !d.spec.pressure;
            balloon.volume = kept_volume(d.spec);
            balloon.gradient.resize(d.count);
            balloons_.push_back(std::move(balloon));
        }
    }

    bool empty() const { return balloons_.empty(); }

    /// One iteration; pressure pushes in the first of a substep alone.
    void iterate(const BodyRows<Real>& rows, double h, bool first, std::uint32_t worker) {
        const Range share = workers_.share(static_cast<std::uint32_t>(balloons_.size()), worker);
        for (std::uint32_t i = share.first; i < share.last; ++i)
            solve(balloons_[i], rows, h, first);
        workers_.barrier();
    }

private:
    struct Balloon {
        const Triangles* triangles;
        std::vector<std::int32_t> rows;
        std::vector<double> inverse_mass;
        std::vector<Vector3d> gradient;  ///< memory
        double volume = 0, pressure = 0;
        bool keeps_volume = true;
    };

    static void solve(Balloon& b, const BodyRows<Real>& rows, double h, bool first) {
        if (!b.keeps_volume && !first) return;
        std::fill(b.gradient.begin(), b.gradient.end(), Vector3d::Zero());
        const Vector3d origin = preview_of(rows, b.rows[0], h);
        const double volume = volume_of(
            *b.triangles,
            [&](std::uint32_t i) -> Vector3d { return preview_of(rows, b.rows[i], h) - origin; },
            &b.gradient);
        double impulse = b.pressure * h;
        if (b.keeps_volume) {
            double response = 0;
            for (std::size_t i = 0; i < b.rows.size(); ++i)
                response += b.inverse_mass[i] * b.gradient[i].squaredNorm();
            if (!(response > 0)) return;
            impulse = (b.volume - volume) / (h * response);
        }
        for (std::size_t i = 0; i < b.rows.size(); ++i)
            add_change(rows, b.rows[i], impulse * b.inverse_mass[i] * b.gradient[i]);
    }

    Workers& workers_;
    std::vector<Balloon> balloons_;
};

}  // namespace plumb
