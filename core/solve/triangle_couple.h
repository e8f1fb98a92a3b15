// SPDX-License-Identifier: MIT
/// Opposite impulses at two points a thickness apart are a couple. The triangle bears it, as a
/// sheet does with friction on one side, so that angular momentum stays.
#pragma once

#include "math/types.h"
#include "world/surface_contacts.h"
#include "world/world.h"

#include <Eigen/LU>

#include <array>

namespace plumb {

class TriangleCouple {
public:
    /// None.
    TriangleCouple() = default;
    /// Of a contact of a particle with a triangle, at the places now.
    TriangleCouple(const Particles& p, const SurfaceContact& c) {
        offset_ = p.position[c.point.particle];
        for (int k = 0; k < 3; ++k) offset_ -= c.weights[k] * p.position[c.triangle[k]];
        double whole = 0;
        Vector3d centre = Vector3d::Zero();
        for (const std::uint32_t corner : c.triangle) {
            if (p.inverse_mass[corner] == 0) return;
            whole += p.mass[corner];
            centre += p.mass[corner] * (p.position[corner] - p.position[c.triangle[0]]);
        }
        centre = p.position[c.triangle[0]] + centre / whole;
        Matrix3d inertia = Matrix3d::Zero();
        for (int k = 0; k < 3; ++k) {
            const Vector3d r = lever_[k] = p.position[c.triangle[k]] - centre;
            inertia += p.mass[c.triangle[k]] *
                       (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
        }
        // a triangle without extent turns about nothing
        const double size = inertia.trace() / 3;
        if (inertia.determinant() > kLeastExtent * size * size * size)
            inverse_inertia_ = inertia.inverse();
    }

    /// How the corners' velocities change with an impulse on the particle.
    std::array<Vector3d, 3> changes_by(const Vector3d& impulse) const {
        const Vector3d turn = -(inverse_inertia_ * offset_.cross(impulse));
        return {turn.cross(lever_[0]), turn.cross(lever_[1]), turn.cross(lever_[2])};
    }

private:
    /// Determinant of a triangle's inertia over that of a ball's of the same trace, from which on
    /// it counts as flat.
    static constexpr double kLeastExtent = 1e-3;

    Vector3d offset_ = Vector3d::Zero();  ///< of the particle from the triangle's point [m]
    std::array<Vector3d, 3> lever_{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
    Matrix3d inverse_inertia_ = Matrix3d::Zero();  ///< of the triangle's particles
};

}  // namespace plumb
