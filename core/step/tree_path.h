// SPDX-License-Identifier: MIT
/// A way to velocities that keep a tree's joints, for where Newton's steps do not find any from v*,
/// what forces and others make of its velocities (step/tree_solver.h). At rest, joints are as they
/// are; from there the solution is followed while v*, and what is closed of old errors, grow from
/// rest to all of it, share by share (numerical continuation: Allgower and Georg, Introduction to
/// Numerical Continuation Methods, SIAM 2003). Where the way ends, the tree is left with that
/// share: it is braked, and no further open than before.
#pragma once

#include "constraints/connector.h"
#include "world/world.h"

namespace plumb {

/// How a tree moves at rest: with the body by which it hangs, else as its bodies would with the
/// momentum that they have if they were one.
class RestMotion {
public:
    /// Of what hangs by a joint from an immovable body.
    RestMotion(const World& world, const Joint& joint);

    /// Of what hangs by nothing: after all bodies are added, with their velocities.
    RestMotion() = default;
    void add(const Bodies& bodies, std::uint32_t body, const Velocity<double>& velocity);
    void find_rates();

    Velocity<double> of(const Bodies& bodies, std::uint32_t body) const;

private:
    Vector3d point_ = Vector3d::Zero();             ///< of the motion, or the center of mass [m]
    Velocity<double> motion_{point_, point_};       ///< of that point [m/s], [rad/s]
    double mass_ = 0;                               ///< [kg]
    Vector3d moment_ = point_, momentum_ = point_;  ///< Σ m x [kg m], Σ m v [kg m/s]
    Vector3d angular_momentum_ = point_;            ///< about the origin [kg m²/s]
    Matrix3d inertia_ = Matrix3d::Zero();           ///< about the origin [kg m²]
};

/// Of a body, while its tree's way is followed.
struct PathNode {
    Velocity<double> goal, rest;  ///< v*, and at rest
    Velocity<double> last;        ///< what was solved for the greatest share so far
    double deferred[6];           ///< of its joint's errors, with the whole share [m], [rad]
};

}  // namespace plumb
