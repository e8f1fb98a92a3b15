// SPDX-License-Identifier: MIT
/// Gives back what levers that turn with their bodies (constraints/joint_lever.h) take of the
/// angular momentum of bodies that hang by nothing and touch nothing immovable.
///
/// What acts among them acts at points of the start's poses, in opposite pairs, and leaves the sum
/// as it is. Where a lever turns with its body it does not: the body resists its turn as if it
/// weighed more, and what holds it does not feel that. All of them are turned by that much about
/// their common centre of mass: of all that brings the sum back this changes the velocities least,
/// and neither contacts nor joints feel it, for what moves as one piece neither slips nor opens.
#pragma once

#include "math/symmetric.h"
#include "solve/rigid_motion.h"
#include "world/body_momentum.h"

#include <Eigen/Cholesky>

#include <cstdint>
#include <vector>

namespace plumb {

/// What is missing by more than this share is not rounding, in double precision.
inline constexpr double kMissing = 1e-12;

/// Bodies that may be turned as one piece.
struct FreeBodies {
    Vector3d centre = Vector3d::Zero();    ///< of mass [m]
    Matrix3d inertia = Matrix3d::Zero();   ///< about it [kg m²]
    Vector3d momentum = Vector3d::Zero();  ///< angular, about it, of the velocities asked about
    double sizes = 0;                      ///< of the momenta of which that is the sum [kg m²/s]

    /// `each(visit)` calls visit(body, velocity) for all of them.
    template <class Each>
    FreeBodies(const Bodies& b, Each each) {
        double mass = 0;
        Vector3d moment = Vector3d::Zero(), origin = Vector3d::Zero();
        each([&](std::uint32_t i, const Velocity<double>&) {
            if (mass == 0) origin = b.position[i];
            mass += b.mass[i], moment += b.mass[i] * (b.position[i] - origin);
        });
        if (mass > 0) centre = origin + moment / mass;
        each([&](std::uint32_t i, const Velocity<double>& v) { add(b, i, v); });
    }

    /// The turn that takes such a momentum from them.
    RigidMotion turn_against(const Vector3d& gained) const {
        const Vector3d rate = -inertia.ldlt().solve(gained);
        return rate.allFinite() ? RigidMotion{centre, {Vector3d::Zero(), rate}} : RigidMotion{};
    }

private:
    void add(const Bodies& b, std::uint32_t i, const Velocity<double>& v) {
        const Vector3d arm = b.position[i] - centre;
        const Vector3d orbit = b.mass[i] * arm.cross(v.v), spin = spin_momentum(b, i, v.w);
        momentum += orbit + spin;
        sizes += orbit.norm() + spin.norm();
        const Matrix3d axes = b.orientation[i].toRotationMatrix();
        inertia += axes * b.inertia[i].asDiagonal() * axes.transpose() +
                   b.mass[i] * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
    }
};

/// The turn that brings the angular momentum back that bodies had before their velocities changed,
/// if more is missing than `rounding` of what they took from each other. `each`: as above, with
/// those changes, at the poses of the start.
template <class Each>
RigidMotion turn_back(const Bodies& b, double rounding, Each each) {
    const FreeBodies all(b, each);
    const bool is_missing = all.momentum.norm() > rounding * all.sizes;
    return is_missing ? all.turn_against(all.momentum) : RigidMotion{};
}

/// Gives it to a tree that was solved by itself. `pushed`: velocities with forces alone, in the
/// order of the bodies [m/s].
inline void turn_back(Bodies& b, const std::vector<std::uint32_t>& bodies,
                      const std::vector<Vector3d>& pushed) {
    const RigidMotion turn = turn_back(b, kMissing, [&](auto visit) {
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            const std::uint32_t i = bodies[k];
            visit(i, {b.velocity[i] - pushed[k], b.turn_change[i]});
        }
    });
    if (turn.is_rest()) return;
    for (const std::uint32_t i : bodies) {
        b.velocity[i] += turn.of(b, i).v;
        b.turn_change[i] += turn.motion.w, b.angular_velocity[i] += turn.motion.w;
    }
}

}  // namespace plumb
