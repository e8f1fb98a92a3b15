// SPDX-License-Identifier: MIT
/// Particles that are joined to bodies bear a share of them.
///
/// A string of grams under a crate takes hundreds of iterations until all of its points have felt
/// the crate, if it is felt by its last point alone. As far as elastic forces go, that point has
/// the mass of the crate instead, so they hold it in one go; then the crate gets what its share of
/// that change is, as an impulse of the link between them, and the link closes what is left open.
///
/// Each of n points that are joined to a body has a share of 1/(n λ), with λ the greatest response
/// of the body to an impulse at any of them. So it is never pushed further than they are.
#pragma once

#include "constraints/connector.h"
#include "math/matrices.h"
#include "solve/particle_rows.h"
#include "world/world.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace plumb {

/// Of each particle [kg], [1/kg]; an inverse of 0 stays where it is.
struct ParticleMass {
    std::vector<double> mass, inverse;

    explicit ParticleMass(const Particles& p) : mass(p.mass), inverse(p.inverse_mass) {}
};

template <class Real>
class JoinedBodies {
public:
    /// `bears`: else particles have their own masses alone.
    JoinedBodies(const World& world, bool bears)
        : mass_(world.particles), impulse_(world.links.size(), Vector3d::Zero()) {
        if (!bears) return;
        for (std::uint32_t i = 0; i < world.links.size(); ++i) {
            const Link& link = world.links[i];
            if (!link.joins || link.compliance > 0) continue;
            add(world, i, link.a, link.b, -1);
            add(world, i, link.b, link.a, 1);
        }
        share_out(world);
    }

    /// Whether no particle bears anything.
    bool empty() const { return joints_.empty(); }

    /// With what they bear.
    const ParticleMass& mass() const { return mass_; }

    /// Once a substep: bodies' inverse masses, and where they are joined.
    void begin(const World& world) {
        const Bodies& b = world.bodies;
        for (Joint& j : joints_) {
            j.arm = world.particles.position[j.particle] - b.position[j.body];
            j.inverse = {b.inverse_mass[j.body], b.world_inverse_inertia[j.body]};
            impulse_[j.link].setZero();
        }
    }

    /// Before elastic forces act, and after: bodies get their share of the change.
    void note(const BodyRows<Real>& rows) {
        for (Joint& j : joints_) j.before = change_of(rows, j.particle_row);
    }
    void give(const BodyRows<Real>& rows) {
        for (const Joint& j : joints_) {
            const Vector3d impulse = j.share * (change_of(rows, j.particle_row) - j.before);
            Velocity<double> change{Vector3d::Zero(), Vector3d::Zero()};
            apply_impulse<double>(change, j.inverse, j.arm, impulse);
            add_change(rows, j.body_row, change);
            impulse_[j.link] += j.sign * impulse;
        }
    }

    /// What a link has passed on so in this substep, on its point a [N s].
    const Vector3d& impulse(std::uint32_t link) const { return impulse_[link]; }

private:
    struct Joint {
        std::uint32_t link, particle, body;
        std::int32_t particle_row, body_row;
        double sign;       ///< of the link's impulse: 1 where a is the body
        Vector3d local;    ///< in the body's frame [m]
        double share = 0;  ///< [kg]
        Vector3d arm = Vector3d::Zero(), before = Vector3d::Zero();
        InverseMass<double> inverse{0, {0, 0, 0, 0, 0, 0}};
    };

    void add(const World& world, std::uint32_t link, const WorldPoint& particle,
             const WorldPoint& to, double sign) {
        if (particle.particle == kNoIndex || to.particle != kNoIndex) return;
        if (to.body == kNoIndex || !(world.bodies.inverse_mass[to.body] > 0)) return;
        joints_.push_back({link, particle.particle, to.body, world.particle_row(particle.particle),
                           world.bodies.row[to.body], sign, to.position});
    }

    void share_out(const World& world) {
        struct Body {
            std::uint32_t points = 0;
            double response = 0;  ///< the greatest [1/kg]
        };
        std::vector<Body> bodies(world.bodies.size());
        for (const Joint& j : joints_) {
            // in the body's frame, so that it does not depend on when the solver is made
            const Vector3d& inertia = world.bodies.inverse_inertia[j.body];
            const InverseMass<double> inverse{world.bodies.inverse_mass[j.body],
                                              {inertia.x(), inertia.y(), inertia.z(), 0, 0, 0}};
            const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(
                matrix_of(point_response(inverse, j.local)), Eigen::EigenvaluesOnly);
            Body& body = bodies[j.body];
            ++body.points, body.response = std::max(body.response, principal.eigenvalues()[2]);
        }
        for (Joint& j : joints_) {
            j.share = 1 / (bodies[j.body].points * bodies[j.body].response);
            mass_.mass[j.particle] += j.share;
        }
        for (const Joint& j : joints_)
            if (mass_.inverse[j.particle] > 0)
                mass_.inverse[j.particle] = 1 / mass_.mass[j.particle];
    }

    ParticleMass mass_;
    std::vector<Joint> joints_;
    std::vector<Vector3d> impulse_;  ///< [link]
};

}  // namespace plumb
