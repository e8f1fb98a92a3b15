// SPDX-License-Identifier: MIT
/// What a user may set of bodies and joints between two steps.
#include "host/simulation_parts.h"
#include "scene/joint_faults.h"
#include "world/edit_world.h"
#include "world/sleep.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumb {
namespace {

void expect_finite(const Eigen::Vector3d& v, const char* what) {
    if (!v.allFinite()) throw std::invalid_argument(std::string(what) + " must be finite numbers");
}

bool follows_keyframes(const Bodies& b, std::uint32_t slot) {
    return b.motion[slot] == Motion::kinematic && !b.script[slot].keyframes.empty();
}

}  // namespace

void expect_placement(const Placement& placement) {
    expect_finite(placement.position, "a position");
    if (!placement.rotation.coeffs().allFinite() || placement.rotation.norm() < 1e-9)
        throw std::invalid_argument("a rotation must be a quaternion other than 0");
}

bool Simulation::has_body(std::uint32_t body) const {
    return parts_->world.slots.find(body).has_value();
}

bool Simulation::has_joint(std::uint32_t joint) const {
    const auto& joints = parts_->world.joints.joints;
    return std::any_of(joints.begin(), joints.end(),
                       [joint](const Joint& j) { return j.id == joint; });
}

std::uint32_t Simulation::slot_of(std::uint32_t body) const { return parts_->slot(body); }

BodyState Simulation::body_state(std::uint32_t body) const {
    const Bodies& b = parts_->world.bodies;
    const std::uint32_t slot = parts_->slot(body);
    return {geometry_placement(b, slot), b.velocity[slot], b.angular_velocity[slot]};
}

void Simulation::set_placement(std::uint32_t body, const Placement& placement) {
    World& world = parts_->world;
    Bodies& b = world.bodies;
    const std::uint32_t slot = parts_->slot(body);
    expect_placement(placement);
    if (follows_keyframes(b, slot))
        throw std::invalid_argument("a body that follows keyframes cannot be placed");
    parts_->wake_near(slot);
    const Placement outer{placement.position, placement.rotation.normalized()};
    const Placement now = outer * inverse(b.geometry_in_body[slot]);
    b.position[slot] = now.position, b.orientation[slot] = now.rotation;
    forget_contacts(world, slot);
    parts_->wake_near(slot);
    parts_->placed = false;
}

void Simulation::set_velocity(std::uint32_t body, const Eigen::Vector3d& v,
                              const Eigen::Vector3d& w) {
    Bodies& b = parts_->world.bodies;
    const std::uint32_t slot = parts_->slot(body);
    expect_finite(v, "a velocity"), expect_finite(w, "an angular velocity");
    if (b.motion[slot] == Motion::fixed)
        throw std::invalid_argument("a fixed body has no velocity");
    if (follows_keyframes(b, slot))
        throw std::invalid_argument("a body that follows keyframes has their velocity");
    parts_->wake_near(slot);
    b.velocity[slot] = v, b.angular_velocity[slot] = w;
}

void Simulation::set_force(std::uint32_t body, const Eigen::Vector3d& force,
                           const Eigen::Vector3d& torque) {
    Bodies& b = parts_->world.bodies;
    const std::uint32_t slot = parts_->slot(body);
    expect_finite(force, "a force"), expect_finite(torque, "a torque");
    if (!is_movable(b.motion[slot]))
        throw std::invalid_argument("only a dynamic body yields to a force");
    parts_->wake_near(slot);
    b.force[slot] = force, b.torque[slot] = torque;
}

void Simulation::set_motor_target(std::uint32_t joint, std::uint32_t axis, double target) {
    const std::uint32_t index = parts_->joint_index(joint);
    if (!(std::abs(target) <= kFurthestTarget))
        throw std::invalid_argument("a motor's target must be finite and within ±1e9");
    for (JointDrive& drive : parts_->world.joints.drives)
        if (drive.joint == index && drive.axis == axis && drive.kind == DriveKind::motor) {
            drive.spec.motor.keys.clear();
            drive.spec.motor.target = target;
            parts_->wake_joined_by(index);
            return;
        }
    throw std::invalid_argument("the joint has no motor on axis " + std::to_string(axis));
}

}  // namespace plumb
