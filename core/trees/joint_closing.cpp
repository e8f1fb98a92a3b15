// SPDX-License-Identifier: MIT
#include "trees/joint_closing.h"

#include "math/rotation_between.h"
#include "ties/joint_state.h"

namespace plumb {
namespace {

/// Two directions are as good as parallel whose cross product is shorter than this.
constexpr double kParallel = 1e-9;

/// The turn of `moved` after which it is perpendicular to `other`.
Quaterniond turn_across(const Vector3d& moved, const Vector3d& other) {
    const Vector3d across = moved - moved.dot(other) * other;
    return across.norm() > kParallel ? rotation_between(moved, across) : Quaterniond::Identity();
}

/// The turn of a body that closes what a joint locks of its rotations. `is_a`: of the joint's a.
Quaterniond closing_turn(const Joint& joint, const JointPose& pose, bool is_a) {
    const Matrix3d &own = is_a ? pose.axes_a : pose.axes_b,
                   &other = is_a ? pose.axes_b : pose.axes_a;
    const int free = free_turns(joint);
    if (free == 3 || joint.angular_compliance > 0) return Quaterniond::Identity();
    if (free == 0) return Quaterniond(Matrix3d(other * own.transpose())).normalized();
    int axis = 0;  // the free one of one, the locked one of two
    while (joint.locked[kTurnX + axis] != (free == 2)) ++axis;
    if (free == 1) return rotation_between(own.col(axis), other.col(axis));
    const int of_a = (axis + 2) % 3, of_b = (axis + 1) % 3;  // are to stay perpendicular
    return turn_across(own.col(is_a ? of_a : of_b), other.col(is_a ? of_b : of_a));
}

/// By how much a's point is off b's along what the joint locks [m].
Vector3d gap_of(const Joint& joint, const JointPose& pose) {
    const Vector3d apart = pose.point_a - pose.point_b;
    Vector3d gap = Vector3d::Zero();
    if (joint.compliance > 0) return gap;
    if (joint.length > 0) {
        const double distance = apart.norm();
        if (joint.locked[kAlongX] && distance > 0) gap = apart * (1 - joint.length / distance);
        return gap;
    }
    for (int k = 0; k < 3; ++k) {
        const Vector3d axis = pose.axes_b.col(k);
        if (joint.locked[k]) gap += axis.dot(apart) * axis;
    }
    return gap;
}

}  // namespace

void close_joint(Bodies& b, const Joint& joint, std::uint32_t moved) {
    const bool is_a = joint.a == moved;
    const Quaterniond turn = closing_turn(joint, joint_pose(b, joint), is_a);
    b.orientation[moved] = (turn * b.orientation[moved]).normalized();
    b.angular_velocity[moved] = turn * b.angular_velocity[moved];
    const Vector3d gap = gap_of(joint, joint_pose(b, joint));
    b.position[moved] += is_a ? Vector3d(-gap) : gap;
}

}  // namespace plumb
