// SPDX-License-Identifier: MIT
/// Forces inside of a deformable have neither a resultant nor a torque.
///
/// Its constraints push where their points will be at the end of the substep, which is stable, and
/// leaves a torque about where the points are at its start; rounding leaves a resultant. Both are
/// taken out again after each iteration as the motion of a rigid body, so that momentum and angular
/// momentum stay to rounding. Deformables that hang on the world have no momentum to keep.
#pragma once

#include "math/types.h"
#include "schedule/workers.h"
#include "solve/particle_rows.h"
#include "world/world.h"

#include <Eigen/LU>

#include <vector>

namespace plumb {

template <class Real>
class MomentumKeeper {
public:
    MomentumKeeper(const World& world, Workers& workers) : workers_(workers) {
        for (std::size_t i = 0; i < world.deformables.size(); ++i) {
            const Deformable& d = world.deformables[i];
            bool is_free = true;
            for (std::uint32_t p = d.first; p < d.first + d.count; ++p)
                is_free = is_free && world.particles.inverse_mass[p] > 0;
            if (is_free) shapes_.push_back({d.first, d.count});
        }
        arm_.resize(world.particles.size());
    }

    /// Once a substep: where the particles are, and their moments of inertia.
    void begin(const World& world) {
        const Particles& p = world.particles;
        first_row_ = world.particle_row(0);
        mass_ = &p.mass;
        for (Shape& s : shapes_) {
            Vector3d centre = Vector3d::Zero();
            s.mass = 0;
            for (std::uint32_t i = s.first; i < s.first + s.count; ++i)
                s.mass += p.mass[i], centre += p.mass[i] * (p.position[i] - p.position[s.first]);
            centre = p.position[s.first] + centre / s.mass;
            Matrix3d inertia = Matrix3d::Zero();
            for (std::uint32_t i = s.first; i < s.first + s.count; ++i) {
                arm_[i] = p.position[i] - centre;
                inertia += p.mass[i] * (arm_[i].squaredNorm() * Matrix3d::Identity() -
                                        arm_[i] * arm_[i].transpose());
            }
            // a straight string has no inertia about itself, and nothing turns it there
            inertia += 1e-13 * inertia.trace() * Matrix3d::Identity();
            s.inverse_inertia = inertia.inverse();
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
            for (std::uint32_t i = s.first; i < s.first + s.count; ++i)
                add_change(rows, row(i), -(v + w.cross(arm_[i])));
        });
    }

private:
    struct Momentum {
        Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
    };
    struct Shape {
        std::uint32_t first, count;
        double mass = 0;
        Matrix3d inverse_inertia = Matrix3d::Zero();
        Momentum before{};
    };

    std::int32_t row(std::uint32_t particle) const {
        return first_row_ + static_cast<std::int32_t>(particle);
    }

    Momentum momentum(const Shape& s, const BodyRows<Real>& rows) const {
        Momentum sum;
        for (std::uint32_t i = s.first; i < s.first + s.count; ++i) {
            const Vector3d p = (*mass_)[i] * change_of(rows, row(i));
            sum.linear += p, sum.angular += arm_[i].cross(p);
        }
        return sum;
    }

    template <class Visit>
    void each(std::uint32_t worker, Visit visit) {
        const Range share = workers_.share(static_cast<std::uint32_t>(shapes_.size()), worker);
        for (std::uint32_t i = share.first; i < share.last; ++i) visit(shapes_[i]);
        workers_.barrier();
    }

    Workers& workers_;
    std::vector<Shape> shapes_;
    std::vector<Vector3d> arm_;  ///< [particle] from the centre of its deformable [m]
    const std::vector<double>* mass_ = nullptr;
    std::int32_t first_row_ = 0;
};

}  // namespace plumb
