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

#include "constraints/connector.h"
#include "math/symmetric.h"
#include "world/body_momentum.h"

#include <Eigen/Cholesky>

#include <cstdint>
#include <vector>

namespace plumb {

/// A turn of bodies as one piece about their centre of mass.
struct FreeTurn {
    Vector3d centre = Vector3d::Zero();  ///< [m]
    Vector3d rate = Vector3d::Zero();    ///< [rad/s]

    bool is_none() const { return rate.isZero(0); }

    /// What it adds to the velocities of body i.
    Velocity<double> of(const Bodies& b, std::uint32_t i) const {
        return {rate.cross(b.position[i] - centre), rate};
    }
};

/// What is missing by more than this share is not rounding, in double precision.
inline constexpr double kMissing = 1e-12;

/// The turn that brings the angular momentum back that bodies had before their velocities changed,
/// if more is missing than `rounding` of what they took from each other. `each(visit)` calls
/// visit(body, change) for all of them, at the poses of the start.
template <class Each>
FreeTurn turn_back(const Bodies& b, double rounding, Each each) {
    double mass = 0;
    Vector3d moment = Vector3d::Zero(), origin = Vector3d::Zero();
    each([&](std::uint32_t i, const Velocity<double>&) {
        if (mass == 0) origin = b.position[i];
        mass += b.mass[i], moment += b.mass[i] * (b.position[i] - origin);
    });
    if (!(mass > 0)) return {};
    FreeTurn turn;
    turn.centre = origin + moment / mass;

    double taken = 0;
    Vector3d gained = Vector3d::Zero();
    Matrix3d inertia = Matrix3d::Zero();
    each([&](std::uint32_t i, const Velocity<double>& change) {
        const Vector3d arm = b.position[i] - turn.centre;
        const Vector3d orbit = b.mass[i] * arm.cross(change.v),
                       spin = spin_momentum(b, i, change.w);
        gained += orbit + spin;
        taken += orbit.norm() + spin.norm();
        const Matrix3d axes = b.orientation[i].toRotationMatrix();
        inertia += axes * b.inertia[i].asDiagonal() * axes.transpose() +
                   b.mass[i] * (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
    });
    if (gained.norm() > rounding * taken) turn.rate = -inertia.ldlt().solve(gained);
    if (!turn.rate.allFinite()) turn.rate.setZero();
    return turn;
}

/// Gives it to a tree that was solved by itself. `pushed`: velocities with forces alone, in the
/// order of the bodies [m/s].
inline void turn_back(Bodies& b, const std::vector<std::uint32_t>& bodies,
                      const std::vector<Vector3d>& pushed) {
    const FreeTurn turn = turn_back(b, kMissing, [&](auto visit) {
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            const std::uint32_t i = bodies[k];
            visit(i, {b.velocity[i] - pushed[k], b.turn_change[i]});
        }
    });
    if (turn.is_none()) return;
    for (const std::uint32_t i : bodies) {
        b.velocity[i] += turn.of(b, i).v;
        b.turn_change[i] += turn.rate, b.angular_velocity[i] += turn.rate;
    }
}

}  // namespace plumb
