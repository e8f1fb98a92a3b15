// SPDX-License-Identifier: MIT
#include "reader/robots/joints.h"

#include <cmath>

#include "math/rotation_between.h"

namespace plumb::reader {

namespace {

std::uint32_t coordinate_axis(const RobotJoint& joint) {
    return joint.is_slider() ? kAlongX : kTurnX;
}

JointKind kind_of(const RobotJoint& joint) {
    if (joint.is_slider()) return JointKind::slider;
    return joint.has_coordinate() ? JointKind::hinge : JointKind::planar;
}

double at_least_0(const RobotJoint& joint, double value, const char* what) {
    if (!(value >= 0) || !std::isfinite(value))
        throw BadRobot(joint_named(joint.name) + ": its " + what + " must be 0 or above");
    return value;
}

/// The motor of a joint, in coordinates that count from `start`.
JointMotor motor_of(const RobotJoint& joint, double start, const RobotMotor& wanted,
                    std::vector<std::string>& remarks) {
    JointMotor motor;
    motor.mode = wanted.mode;
    motor.target = wanted.mode == MotorMode::position ? wanted.target - start : wanted.target;
    motor.frequency = wanted.frequency, motor.damping_ratio = wanted.damping_ratio;
    if (wanted.greatest)
        motor.greatest = *wanted.greatest;
    else if (joint.greatest_effort)
        motor.greatest = at_least_0(joint, *joint.greatest_effort, "limit of effort");
    if (motor.greatest == 0)
        remarks.push_back(joint_named(joint.name) +
                          " has a motor without force: its limit of effort is 0");
    return motor;
}

void add_motor(JointAxisSpec& axis, const RobotJoint& joint, double start,
               const RobotOptions& options, std::vector<std::string>& remarks) {
    if (const auto found = options.motors.find(joint.name); found != options.motors.end()) {
        axis.motor = motor_of(joint, start, found->second, remarks);
    } else if (options.hold && !joint.mimic) {
        RobotMotor hold;
        hold.target = start;
        axis.motor = motor_of(joint, start, hold, remarks);
    }
}

}  // namespace

JointSpec joint_of(const LinkGroup& group, double start, const RobotOptions& options,
                   std::vector<std::string>& remarks) {
    const RobotJoint& joint = *group.joint;
    JointSpec spec;
    spec.kind = kind_of(joint);
    spec.anchor = group.world.position;
    spec.frame = (group.world.rotation * rotation_between(Eigen::Vector3d::UnitX(), axis_of(joint)))
                     .normalized();
    if (!joint.has_coordinate()) return spec;

    JointAxisSpec& axis = spec.axes[coordinate_axis(joint)];
    if (joint.limits)
        axis.lower = joint.limits->lower - start, axis.upper = joint.limits->upper - start;
    if (joint.greatest_speed)
        axis.greatest_speed = at_least_0(joint, *joint.greatest_speed, "limit of velocity");
    axis.damping = at_least_0(joint, joint.damping, "damping");
    axis.friction = at_least_0(joint, joint.friction, "friction");
    add_motor(axis, joint, start, options, remarks);
    return spec;
}

CouplingSpec coupling_of(const RobotJoint& joint, const RobotJoint& mimicked,
                         const std::map<std::string, double>& starts) {
    if (joint.mimic->multiplier == 0)
        throw BadRobot(joint_named(joint.name) + " mimics \"" + mimicked.name +
                       "\" with a multiplier of 0; a fixed joint does the same");
    CouplingSpec coupling;
    coupling.axis_a = coordinate_axis(mimicked), coupling.axis_b = coordinate_axis(joint);
    coupling.ratio = joint.mimic->multiplier;
    coupling.offset =
        coupling.ratio * starts.at(mimicked.name) + joint.mimic->offset - starts.at(joint.name);
    if (!std::isfinite(*coupling.offset))
        throw BadRobot(joint_named(joint.name) + ": its mimic's numbers are too large");
    return coupling;
}

void check_motors(const RobotDescription& robot, const RobotOptions& options) {
    for (const auto& entry : options.motors)
        if (!known_joint(robot, entry.first).has_coordinate())
            throw BadRobot(joint_named(entry.first) +
                           " neither turns nor slides along one axis, so it cannot have a motor");
}

}  // namespace plumb::reader
