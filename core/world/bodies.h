// SPDX-License-Identifier: MIT
/// The bodies' state as tables, one column a quantity, indexed by body.
///
/// A body's own frame has its origin in the centre of mass and its axes along the principal axes of
/// inertia. The slot of a body that was removed is vacant until another takes it: fixed, without
/// mass and shape.
#pragma once

#include "math/symmetric.h"
#include "math/types.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace plumb {

struct Bodies {
    std::vector<std::uint32_t>
        id;  ///< what the body is called as long as it lives; kNoIndex: the slot is vacant
    std::vector<Motion> motion;
    std::vector<Vector3d> position;          ///< of the centre of mass [m]
    std::vector<Quaterniond> orientation;    ///< body frame → world
    std::vector<Vector3d> velocity;          ///< of the centre of mass [m/s]
    std::vector<Vector3d> angular_velocity;  ///< [rad/s], world frame

    std::vector<double> mass, inverse_mass;  ///< [kg], [1/kg]; 0 and 0 unless dynamic; what sleeps
                                             ///< keeps its mass
    std::vector<Vector3d> inertia,
        inverse_inertia;                  ///< principal moments, body frame [kg m²]; the same
    std::vector<std::uint8_t> isotropic;  ///< 1: all moments equal, so there is no gyroscopic term
    std::vector<Vector3d> force, torque;  ///< constant, world frame [N], [N m]

    std::vector<Placement>
        geometry_in_body;                 ///< where the geometry's frame sits in the body's frame
    std::vector<std::uint32_t> geometry;  ///< index into World::shapes; kNoIndex: none
    std::vector<double> bounding_radius;  ///< about the centre of mass; it holds the geometry [m]
    std::vector<std::uint32_t> material;
    std::vector<std::uint32_t> group, mask;  ///< as in ShapePlacement; 0 for bodies without a shape
    std::vector<MotionScript>
        script;  ///< of kinematic bodies: where the centre of mass and principal axes are

    std::vector<double>
        lost_to_ground;  ///< what a body lost on fixed ground and may regain (still_ground.h) [J]

    std::vector<double> rest_time;              ///< for how long it has been slower than
                                                ///< Settings::sleep_speed [s]
    std::vector<Vector3d> rest_way, rest_turn;  ///< by how much it has moved and turned since it
                                                ///< was last asked whether it rests [m], [rad]
    std::vector<std::uint32_t> sleeps_with;  ///< while it sleeps, the first of all bodies that fell
                                             ///< asleep together; else kNoIndex

    // The substep's own columns.
    std::vector<std::int32_t> row;                          ///< row in the solver's velocity table
    std::vector<Symmetric3<double>> world_inverse_inertia;  ///< at the start of the substep
    std::vector<Vector3d>
        angular_momentum;  ///< carried through the substep where `isotropic` is 0 [kg m²/s]
    std::vector<Vector3d> velocity_now, angular_velocity_now;  ///< at the start of the substep,
                                                               ///< without its forces
    std::vector<Vector3d> velocity_before, angular_velocity_before;  ///< and of the one before it
    std::vector<Vector3d> turn_change;  ///< of the angular velocity, by the passes [rad/s]

    std::size_t size() const { return motion.size(); }
};

/// A point in the frame of body i, and in the world [m].
inline Vector3d in_body(const Bodies& bodies, std::size_t i, const Vector3d& point) {
    return bodies.orientation[i].conjugate() * (point - bodies.position[i]);
}
inline Vector3d in_world(const Bodies& bodies, std::size_t i, const Vector3d& point) {
    return bodies.position[i] + bodies.orientation[i] * point;
}

/// Whether the bounding spheres of two bodies are farther apart than that [m]; what goes on for
/// ever is near everything.
inline bool spheres_are_apart(const Bodies& bodies, std::size_t a, std::size_t b, double distance) {
    const double reach = bodies.bounding_radius[a] + bodies.bounding_radius[b] + distance;
    return (bodies.position[a] - bodies.position[b]).squaredNorm() > reach * reach;
}

/// Where the body's geometry is in the world.
inline Placement geometry_placement(const Bodies& bodies, std::size_t i) {
    const Placement& local = bodies.geometry_in_body[i];
    return {in_world(bodies, i, local.position), bodies.orientation[i] * local.rotation};
}

}  // namespace plumb
