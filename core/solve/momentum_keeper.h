// SPDX-License-Identifier: MIT
/// Forces inside of a deformable have neither a resultant nor a torque.
///
/// Its constraints push where their points will be at the end of the substep, which is stable, and
/// leaves a torque about where the points are at its start; rounding leaves a resultant. Both are
/// taken out again after each iteration as the motion of a rigid body, so that momentum and angular
/// momentum stay to rounding: of each piece that hangs together, for others are none of its
/// business. Pieces that hang on the world have no momentum to keep.
#pragma once

#include "math/types.h"
#include "schedule/workers.h"
#include "solve/joined_bodies.h"
#include "solve/particle_rows.h"
#include "world/world.h"

#include <Eigen/LU>

#include <algorithm>
#include <numeric>
#include <vector>

namespace plumb {

template <class Real>
class MomentumKeeper {
public:
    /// `mass` outlives the keeper.
    MomentumKeeper(const World& world, const ParticleMass& mass, Workers& workers)
        : workers_(workers), mass_(mass) {
        for (const Deformable& d : world.deformables) add_pieces(d);
        arm_.resize(world.particles.size());
    }

    /// Once a substep: where the particles are, and their moments of inertia.
    void begin(const World& world) {
        const Particles& p = world.particles;
        first_row_ = world.particle_row(0);
        for (Shape& s : shapes_) {
            Vector3d centre = Vector3d::Zero();
            s.mass = 0;
            const Vector3d& near = p.position[member_[s.first]];
            each_member(s, [&](std::uint32_t i) {
                s.mass += mass_.mass[i], centre += mass_.mass[i] * (p.position[i] - near);
            });
            centre = near + centre / s.mass;
            Matrix3d inertia = Matrix3d::Zero();
            each_member(s, [&](std::uint32_t i) {
                arm_[i] = p.position[i] - centre;
                inertia += mass_.mass[i] * (arm_[i].squaredNorm() * Matrix3d::Identity() -
                                            arm_[i] * arm_[i].transpose());
            });
            // a straight string has no inertia about itself, and nothing turns it there
            inertia += 1e-13 * inertia.trace() * Matrix3d::Identity();
            s.inverse_inertia = inertia.inverse();
        }
    }

    /// Pieces that touch what does not move have no momentum to keep either. `touches`: [particle]
    void leave(const std::vector<std::uint8_t>& touches) {
        for (Shape& s : shapes_) {
            s.is_left = false;
            each_member(s, [&](std::uint32_t i) { s.is_left |= touches[i] != 0; });
        }
    }

    /// Before and after the constraints of an iteration.
    void note(const BodyRows<Real>& rows, std::uint32_t worker) {
        each(worker, [&](Shape& s) { s.before = momentum(s, rows); });
    }
    void restore(const BodyRows<Real>& rows, std::uint32_t worker) {
        each(worker, [&](Shape& s) {
            const Momentum now = momentum(s, rows);
            const Vector3d v = (now.linear - s.before.linear) / s.mass;
            const Vector3d w = s.inverse_inertia * (now.angular - s.before.angular);
            each_member(
                s, [&](std::uint32_t i) { add_change(rows, row(i), -(v + w.cross(arm_[i]))); });
        });
    }

private:
    struct Momentum {
        Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
    };
    /// A piece that hangs together: [first, last) of `member_`.
    struct Shape {
        std::uint32_t first, last;
        double mass = 0;
        Matrix3d inverse_inertia = Matrix3d::Zero();
        Momentum before{};
        bool is_left = false;
    };

    /// The free pieces of a deformable, by their lowest points.
    void add_pieces(const Deformable& d) {
        std::vector<std::uint32_t> lower(d.count);  // a point of the same piece, or itself
        std::iota(lower.begin(), lower.end(), 0u);
        const auto lowest = [&](std::uint32_t i) {
            while (lower[i] != i) i = lower[i] = lower[lower[i]];
            return i;
        };
        const auto hang_together = [&](const auto& elements) {
            for (const auto& element : elements)
                for (const std::uint32_t point : element) {
                    const std::uint32_t a = lowest(element[0]), b = lowest(point);
                    lower[std::max(a, b)] = std::min(a, b);
                }
        };
        hang_together(d.spec.segments), hang_together(d.spec.triangles);
        hang_together(d.spec.tetrahedra);
        std::vector<std::vector<std::uint32_t>> pieces(d.count);
        for (std::uint32_t i = 0; i < d.count; ++i) pieces[lowest(i)].push_back(d.first + i);
        for (const std::vector<std::uint32_t>& piece : pieces) {
            const bool is_free = std::all_of(piece.begin(), piece.end(),
                                             [&](std::uint32_t i) { return mass_.inverse[i] > 0; });
            // nothing inside of a single point pushes it
            if (piece.size() < 2 || !is_free) continue;
            const auto first = static_cast<std::uint32_t>(member_.size());
            member_.insert(member_.end(), piece.begin(), piece.end());
            shapes_.push_back({first, static_cast<std::uint32_t>(member_.size())});
        }
    }

    template <class Visit>
    void each_member(const Shape& s, Visit visit) const {
        for (std::uint32_t k = s.first; k < s.last; ++k) visit(member_[k]);
    }

    std::int32_t row(std::uint32_t particle) const {
        return first_row_ + static_cast<std::int32_t>(particle);
    }

    Momentum momentum(const Shape& s, const BodyRows<Real>& rows) const {
        Momentum sum;
        each_member(s, [&](std::uint32_t i) {
            const Vector3d p = mass_.mass[i] * change_of(rows, row(i));
            sum.linear += p, sum.angular += arm_[i].cross(p);
        });
        return sum;
    }

    template <class Visit>
    void each(std::uint32_t worker, Visit visit) {
        const Range share = workers_.share(static_cast<std::uint32_t>(shapes_.size()), worker);
        for (std::uint32_t i = share.first; i < share.last; ++i)
            if (!shapes_[i].is_left) visit(shapes_[i]);
        workers_.barrier();
    }

    Workers& workers_;
    std::vector<Shape> shapes_;
    std::vector<std::uint32_t> member_;  ///< particles, piece by piece
    std::vector<Vector3d> arm_;          ///< [particle] from the centre of its piece [m]
    const ParticleMass& mass_;
    std::int32_t first_row_ = 0;
};

}  // namespace plumb
