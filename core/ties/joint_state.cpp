// SPDX-License-Identifier: MIT
#include "ties/joint_state.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr double kWholeTurn = 6.283185307179586;

/// An arm of less than this share of the body's radius of gyration counts as if it were as long.
constexpr double kShort = 0.05;

/// The axis of the one rotation that a joint leaves free, kJointAxes where there is none or more.
std::uint32_t single_turn(const Joint& joint) {
    if (joint.kind == JointKind::cone_twist || free_turns(joint) != 1) return kJointAxes;
    for (std::uint32_t axis = kTurnX; axis <= kTurnZ; ++axis)
        if (!joint.locked[axis]) return axis;
    return kJointAxes;
}

}  // namespace

JointPose joint_pose(const Bodies& b, const Joint& joint) {
    JointPose pose;
    const auto put = [&](std::uint32_t body, const Placement& frame, Vector3d& point,
                         Matrix3d& axes, Vector3d& centre) {
        if (body == kNoIndex) {
            point = frame.position, axes = frame.rotation.toRotationMatrix();
            centre = Vector3d::Zero();
            return;
        }
        centre = b.position[body];
        point = centre + b.orientation[body] * frame.position;
        axes = (b.orientation[body] * frame.rotation).toRotationMatrix();
    };
    put(joint.a, joint.frame_a, pose.point_a, pose.axes_a, pose.centre_a);
    put(joint.b, joint.frame_b, pose.point_b, pose.axes_b, pose.centre_b);
    return pose;
}

double joint_gap(const Bodies& b, const Joint& joint) {
    return joint.broken ? 0 : joint_gap(joint, joint_pose(b, joint));
}

double joint_gap(const Joint& joint, const JointPose& pose) {
    const Vector3d apart = pose.point_a - pose.point_b;
    if (joint.length > 0) return joint.locked[kAlongX] ? std::abs(apart.norm() - joint.length) : 0;
    Vector3d gap = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
        if (joint.locked[k]) gap[k] = pose.axes_b.col(k).dot(apart);
    return gap.norm();
}

double joint_turn_gap(const Bodies& b, const Joint& joint) {
    if (joint.broken) return 0;
    const auto turned = [&](std::uint32_t body, const Vector3d& v) -> Vector3d {
        return body == kNoIndex ? v : Vector3d(b.orientation[body] * v);
    };
    Vector3d gap = Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
        if (joint.locked[kTurnX + k])
            gap[k] = turned(joint.a, joint.turns[k].u).dot(turned(joint.b, joint.turns[k].w));
    return gap.norm();
}

int free_turns(const Joint& joint) {
    return !joint.locked[kTurnX] + !joint.locked[kTurnY] + !joint.locked[kTurnZ];
}

JointCoordinate joint_coordinate(const World& world, std::uint32_t index, std::uint32_t axis) {
    return joint_coordinate(world, index, axis,
                            joint_pose(world.bodies, world.joints.joints[index]));
}

JointCoordinate joint_coordinate(const World& world, std::uint32_t index, std::uint32_t axis,
                                 const JointPose& pose) {
    const Joint& joint = world.joints.joints[index];
    JointCoordinate q = joint_coordinate(joint, pose, axis);
    if (axis == single_turn(joint))
        q.value += kWholeTurn * std::round((world.joints.turn[index] - q.value) / kWholeTurn);
    return q;
}

namespace {

double rate_of(const std::vector<Vector3d>& v, const std::vector<Vector3d>& w, const Joint& joint,
               const JointCoordinate& q) {
    const auto part = [&](std::uint32_t body, const Vector3d& turn) {
        return body == kNoIndex ? 0.0 : q.along.dot(v[body]) + turn.dot(w[body]);
    };
    return part(joint.a, q.turn_a) - part(joint.b, q.turn_b);
}

}  // namespace

double joint_rate(const Bodies& b, const Joint& joint, const JointCoordinate& q) {
    return rate_of(b.velocity, b.angular_velocity, joint, q);
}
double joint_rate_before(const Bodies& b, const Joint& joint, const JointCoordinate& q) {
    return rate_of(b.velocity_now, b.angular_velocity_now, joint, q);
}

double angular_rate(const Bodies& b, const Joint& joint, std::uint32_t body,
                    const Placement& frame) {
    if (body == kNoIndex) return 0;
    const Vector3d& w = b.angular_velocity[body];
    // an arm that is short against the body's radius of gyration turns it next to nothing
    const double gyration = std::sqrt(b.inertia[body].maxCoeff() * b.inverse_mass[body]);
    const double reach = std::max(frame.position.norm(), kShort * gyration);
    double rate = 0;
    if (reach > 0) rate = w.cross(b.orientation[body] * frame.position).norm() / reach;
    const int free = free_turns(joint);
    if (free == 3) return rate;
    if (free != 1) return std::max(rate, w.norm());
    int axis = 0;
    while (joint.locked[kTurnX + axis]) ++axis;
    const Vector3d along = b.orientation[body] * (frame.rotation * Vector3d::Unit(axis));
    return std::max(rate, w.cross(along).norm());
}

double eccentric_spin(const Bodies& b, std::uint32_t body, const Placement& frame) {
    if (body == kNoIndex || b.motion[body] != Motion::dynamic) return 0;
    const Vector3d w = b.orientation[body].conjugate() * b.angular_velocity[body];
    const double square = w.squaredNorm();
    const double energy = w.dot(b.inertia[body].cwiseProduct(w)) * b.inverse_mass[body];
    const double missed = w.cross(frame.position).squaredNorm();
    return energy > 0 ? std::sqrt(square) * std::min(1.0, missed / energy) : 0;
}

JointLoad joint_load(const World& world, std::uint32_t index) {
    const Joint& joint = world.joints.joints[index];
    const JointPose pose = joint_pose(world.bodies, joint);
    const double per_second = 0.5 * world.settings.substeps / world.settings.dt;
    JointLoad load;
    const auto turned = [&](std::uint32_t body, const Vector3d& v) -> Vector3d {
        return body == kNoIndex ? v : Vector3d(world.bodies.orientation[body] * v);
    };
    const Vector3d apart = pose.point_a - pose.point_b;
    for (int k = 0; k < 3; ++k) {
        Vector3d along =
            joint.is_plain_ball() ? Vector3d(Vector3d::Unit(k)) : Vector3d(pose.axes_b.col(k));
        if (joint.length > 0 && apart.norm() > 0) along = apart.normalized();
        load.force += (joint.rows[k] + joint.rows_before[k]) * along;
        load.torque += (joint.rows[3 + k] + joint.rows_before[3 + k]) *
                       turned(joint.a, joint.turns[k].u).cross(turned(joint.b, joint.turns[k].w));
    }
    for (const JointDrive& drive : world.joints.drives) {
        if (drive.joint != index) continue;
        const JointCoordinate q = joint_coordinate(world, index, drive.axis);
        const double impulse = drive.impulse + drive.impulse_before;
        load.force += impulse * q.along;
        if (q.along.isZero()) load.torque += impulse * q.turn_a;
    }
    return {per_second * load.force, per_second * load.torque};
}

std::vector<std::uint32_t> revolute_joints(const World& world) {
    std::vector<std::uint32_t> revolute;
    for (std::uint32_t i = 0; i < world.joints.size(); ++i)
        if (single_turn(world.joints.joints[i]) < kJointAxes) revolute.push_back(i);
    return revolute;
}

void count_turns(World& world, const std::vector<std::uint32_t>& revolute) {
    for (const std::uint32_t i : revolute)
        world.joints.turn[i] =
            joint_coordinate(world, i, single_turn(world.joints.joints[i])).value;
}

}  // namespace plumb
