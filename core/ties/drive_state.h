// SPDX-License-Identifier: MIT
/// What drives a joint, as rows of the substep that begins.
#pragma once

#include "constraints/drive_rows.h"
#include "constraints/effective_mass.h"
#include "ties/joint_geometry.h"

namespace plumb {

/// What a drive at q moves while its joint holds [kg], [kg m²]; 0 where nothing can move.
inline double driven_mass(const World& world, const Joint& joint, const JointGeometry<double>& g,
                          const JointCoordinate& q) {
    return effective_mass(g, q, inverse_mass(world.bodies, joint.a),
                          inverse_mass(world.bodies, joint.b));
}

/// `mass`: driven_mass, of springs.
inline DriveRow drive_row(const World& world, const JointDrive& drive, const JointCoordinate& q,
                          double mass, const SubstepTime& time) {
    const JointAxisSpec& spec = drive.spec;
    const Joint& joint = world.joints.joints[drive.joint];
    const MotorTarget target = motor_target(spec.motor, time.end());
    const Bodies& b = world.bodies;
    const AxisMotion axis{q.value, joint_rate_before(b, joint, q), mass, joint.crowd};
    switch (drive.kind) {
        case DriveKind::limit:
            return limit_row(q.value, axis.rate, spec.lower, spec.upper, world.settings.stiffness,
                             world.settings.recovery_speed, time.h);
        case DriveKind::motor:
            if (spec.motor.mode == MotorMode::velocity)
                return velocity_motor_row(target.value, spec.motor.greatest, time);
            return position_motor_row(axis, target.value, target.speed, spec.motor, time);
        case DriveKind::spring:
            return spring_row(axis, spec.rest, 0, spec.stiffness, spec.damping, time);
        case DriveKind::friction:
            return friction_row(spec.friction, time);
        case DriveKind::speed:
            return speed_row(joint_rate(b, joint, q), spec.greatest_speed);
    }
    return {};
}

}  // namespace plumb
