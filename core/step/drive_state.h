// SPDX-License-Identifier: MIT
/// What drives a joint, as rows of the substep that begins.
#pragma once

#include "constraints/drive_rows.h"
#include "constraints/felt_mass.h"
#include "step/joint_geometry.h"

namespace plumb {

inline InverseMass<double> inverse_mass(const Bodies& b, std::uint32_t body) {
    if (body == kNoIndex) return {0, {0, 0, 0, 0, 0, 0}};
    return {b.inverse_mass[body], b.world_inverse_inertia[body]};
}

/// What a drive at q moves while its joint holds [kg], [kg m²]; 0 where nothing can move.
inline double driven_mass(const World& world, const Joint& joint, const JointCoordinate& q,
                          double h) {
    return felt_mass(joint_geometry(world, joint, h), q, inverse_mass(world.bodies, joint.a),
                     inverse_mass(world.bodies, joint.b));
}

/// `mass`: driven_mass of a motor that goes to a place; others do without. h: substep [s].
inline DriveRow drive_row(const World& world, const JointDrive& drive, const JointCoordinate& q,
                          double mass, double h) {
    const JointAxisSpec& spec = drive.spec;
    const MotorTarget target = motor_target(spec.motor, world.time + h);
    switch (drive.kind) {
        case DriveKind::limit:
            return limit_row(q.value, spec.lower, spec.upper, world.settings.stiffness,
                             world.settings.recovery_speed, h);
        case DriveKind::motor:
            if (spec.motor.mode == MotorMode::velocity)
                return velocity_motor_row(target.value, spec.motor.greatest, h);
            return position_motor_row(q.value, target.value, target.speed, spec.motor, mass, h);
        case DriveKind::spring:
            return spring_row(q.value, spec.rest, 0, spec.stiffness, spec.damping, h);
        case DriveKind::friction:
            return friction_row(spec.friction, h);
        case DriveKind::speed:
            return speed_row(joint_rate(world.bodies, world.joints.joints[drive.joint], q),
                             spec.greatest_speed);
    }
    return {};
}

inline bool goes_to_a_place(const JointDrive& drive) {
    return drive.kind == DriveKind::motor && drive.spec.motor.mode == MotorMode::position;
}

}  // namespace plumb
