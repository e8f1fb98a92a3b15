// SPDX-License-Identifier: MIT
#include "reader/urdf_joints.h"

#include <cmath>

#include "math/rotation_between.h"
#include "scene/nearest.h"

namespace plumb::reader {

namespace {

std::uint32_t coordinate_axis(const urdf::Joint& joint) {
    return is_prismatic(joint) ? kAlongX : kTurnX;
}

JointKind kind_of(const urdf::Joint& joint) {
    if (is_prismatic(joint)) return JointKind::slider;
    return has_coordinate(joint) ? JointKind::hinge : JointKind::planar;
}

double at_least_0(const urdf::Joint& joint, double value, const char* what) {
    if (!(value >= 0) || !std::isfinite(value))
        throw BadRobot(joint_named(joint.name) + ": its " + what + " must be 0 or above");
    return value;
}

/// The motor of a joint, in coordinates that count from `start`.
JointMotor motor_of(const urdf::Joint& joint, double start, const RobotMotor& wanted,
                    std::vector<std::string>& remarks) {
    JointMotor motor;
    motor.mode = wanted.mode;
    motor.target = wanted.mode == MotorMode::position ? wanted.target - start : wanted.target;
    motor.frequency = wanted.frequency, motor.damping_ratio = wanted.damping_ratio;
    if (wanted.greatest)
        motor.greatest = *wanted.greatest;
    else if (joint.limits)
        motor.greatest = at_least_0(joint, joint.limits->effort, "limit of effort");
    if (motor.greatest == 0)
        remarks.push_back(joint_named(joint.name) +
                          " has a motor without force: its limit of effort is 0");
    return motor;
}

void add_motor(JointAxisSpec& axis, const urdf::Joint& joint, double start,
               const UrdfOptions& options, std::vector<std::string>& remarks) {
    if (const auto found = options.motors.find(joint.name); found != options.motors.end()) {
        axis.motor = motor_of(joint, start, found->second, remarks);
    } else if (options.hold && !joint.mimic) {
        RobotMotor hold;
        hold.target = start;
        axis.motor = motor_of(joint, start, hold, remarks);
    }
}

}  // namespace

JointSpec joint_of(const LinkGroup& group, double start, const UrdfOptions& options,
                   std::vector<std::string>& remarks) {
    const urdf::Joint& joint = *group.joint;
    JointSpec spec;
    spec.kind = kind_of(joint);
    spec.anchor = group.world.position;
    spec.frame = (group.world.rotation * rotation_between(Eigen::Vector3d::UnitX(), axis_of(joint)))
                     .normalized();
    if (!has_coordinate(joint)) {
        if (joint.limits || joint.dynamics)
            remarks.push_back(joint_named(joint.name) +
                              " is planar: its limits, damping and friction are left out");
        return spec;
    }

    JointAxisSpec& axis = spec.axes[coordinate_axis(joint)];
    if (has_limits(joint))
        axis.lower = joint.limits->lower - start, axis.upper = joint.limits->upper - start;
    if (joint.limits && joint.limits->velocity != 0)  // many files have 0 where they mean none
        axis.greatest_speed = at_least_0(joint, joint.limits->velocity, "limit of velocity");
    if (joint.dynamics) {
        axis.damping = at_least_0(joint, joint.dynamics->damping, "damping");
        axis.friction = at_least_0(joint, joint.dynamics->friction, "friction");
    }
    add_motor(axis, joint, start, options, remarks);
    return spec;
}

CouplingSpec coupling_of(const urdf::Joint& joint, const urdf::Joint& mimicked,
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

void check_motors(const urdf::ModelInterface& model, const UrdfOptions& options) {
    std::vector<std::string> names;
    for (const auto& [name, joint] : model.joints_) {
        if (has_coordinate(*joint)) names.push_back(name);
    }
    for (const auto& entry : options.motors) {
        const auto found = model.joints_.find(entry.first);
        if (found == model.joints_.end())
            throw BadRobot("there is no " + joint_named(entry.first) + advice(entry.first, names));
        if (!has_coordinate(*found->second))
            throw BadRobot(joint_named(entry.first) +
                           " neither turns nor slides along one axis, so it cannot have a motor");
    }
}

}  // namespace plumb::reader
