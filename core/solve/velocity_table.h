// SPDX-License-Identifier: MIT
/// The solver's unknowns: one row a body, 32 bytes in single and 64 in double precision.
///
/// Because every displacement is followed at once by its velocity (§3, end), x = x₀ + h v holds
/// throughout the iterations, and velocity and preview position are one unknown. Rows hold the
/// change since the start of the substep, so that single precision loses nothing of gravity at tiny
/// steps.
#pragma once

#include "constraints/connector.h"
#include "schedule/contact_rows.h"
#include "world/world.h"

#include <vector>

namespace plumb {

/// One row of such a table.
template <class Real>
inline Velocity<Real> velocity_in(const Real* rows, std::int32_t row) {
    const Real* x = rows + static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
    return {{x[0], x[1], x[2]}, {x[4], x[5], x[6]}};
}
template <class Real>
inline void put_velocity(Real* rows, std::int32_t row, const Velocity<Real>& velocity) {
    Real* x = rows + static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
    for (int k = 0; k < 3; ++k) x[k] = velocity.v[k], x[4 + k] = velocity.w[k];
}

template <class Real>
class VelocityTable {
public:
    /// Takes the velocities at the start of a substep, forces included, and clears the changes.
    void begin(const World& world, double h) {
        begin(world, world.bodies.velocity, world.bodies.angular_velocity);
        begin_particles(world, h);
    }
    /// The same with any velocities, [body].
    void begin(const World& world, const std::vector<Vector3d>& velocity,
               const std::vector<Vector3d>& angular_velocity) {
        const std::size_t rows = static_cast<std::size_t>(world.zero_row()) + 1;
        start_.assign(rows * kBodyRowSize, Real(0));
        change_.assign(rows * kBodyRowSize, Real(0));
        dynamic_count_ = world.moving_count();
        for (std::size_t i = 0; i < world.bodies.size(); ++i) {
            if (world.bodies.motion[i] == Motion::fixed) continue;
            Real* row = start_.data() + world.bodies.row[i] * kBodyRowSize;
            for (int k = 0; k < 3; ++k) {
                row[k] = static_cast<Real>(velocity[i][k]);
                row[4 + k] = static_cast<Real>(angular_velocity[i][k]);
            }
        }
    }

    BodyRows<Real> rows() {
        return {change_.data(), start_.data(), dynamic_count_, preview_.data()};
    }

    void take_changes(Bodies& bodies) const {
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (bodies.motion[i] != Motion::dynamic) continue;
            const Real* row = change_.data() + bodies.row[i] * kBodyRowSize;
            for (int k = 0; k < 3; ++k) {
                bodies.velocity[i][k] += static_cast<double>(row[k]);
                bodies.turn_change[i][k] = static_cast<double>(row[4 + k]);
                bodies.angular_velocity[i][k] += bodies.turn_change[i][k];
            }
        }
    }

    void take_changes(const World& world, Particles& particles) const {
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const Real* row = change_.data() + world.particle_row(i) * kBodyRowSize;
            for (int k = 0; k < 3; ++k) particles.velocity[i][k] += static_cast<double>(row[k]);
        }
    }

private:
    /// Places are told against the first particle, and what does not fit into one number goes into
    /// a second.
    void begin_particles(const World& world, double h) {
        const Particles& p = world.particles;
        if (p.size() == 0) return;
        preview_.assign(start_.size(), Real(0));
        for (std::size_t i = 0; i < p.size(); ++i) {
            const auto at = world.particle_row(i) * kBodyRowSize;
            const Vector3d place = (p.position[i] - p.position[0]) + h * p.velocity[i];
            for (int k = 0; k < 3; ++k) {
                const Real high = static_cast<Real>(place[k]);
                start_[at + k] = static_cast<Real>(p.velocity[i][k]);
                preview_[at + k] = high;
                preview_[at + 4 + k] = static_cast<Real>(place[k] - static_cast<double>(high));
            }
        }
    }

    std::vector<Real> start_, change_, preview_;
    std::int32_t dynamic_count_ = 0;
};

}  // namespace plumb
