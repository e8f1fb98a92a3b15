// SPDX-License-Identifier: MIT
/// Where the world's joints stand.
#pragma once

#include "constraints/joint_axis.h"
#include "world/world.h"

#include <vector>

namespace plumb {

JointPose joint_pose(const Bodies& bodies, const Joint& joint);

/// How far a joint's points have parted along what it locks [m], and its bodies have turned against
/// each other about what it locks [rad]; 0 of one that is broken.
double joint_gap(const Bodies& bodies, const Joint& joint);
double joint_turn_gap(const Bodies& bodies, const Joint& joint);
/// The former, of a joint that is whole and whose pose is known.
double joint_gap(const Joint& joint, const JointPose& pose);

/// How many rotations a joint leaves free.
int free_turns(const Joint& joint);

/// The coordinate of a joint along or about an axis that it leaves free. The angle about a single
/// free axis is counted through whole turns.
JointCoordinate joint_coordinate(const World& world, std::uint32_t joint, std::uint32_t axis);
/// The same, where the joint's pose is known.
JointCoordinate joint_coordinate(const World& world, std::uint32_t joint, std::uint32_t axis,
                                 const JointPose& pose);

/// How fast a coordinate of a joint changes [m/s], [rad/s].
double joint_rate(const Bodies& bodies, const Joint& joint, const JointCoordinate& q);
/// And how fast it did before forces acted in this substep.
double joint_rate_before(const Bodies& bodies, const Joint& joint, const JointCoordinate& q);

/// How fast what a joint sees of a body turns: the arm, and the axes that it keeps [rad/s].
/// `frame`: the joint's on the body.
double angular_rate(const Bodies& bodies, const Joint& joint, std::uint32_t body,
                    const Placement& frame);

/// How fast a body spins about an axis that misses its joint, as far as the joint's pull turns it
/// about that axis: wholly where the joint is no nearer to it than its radius of gyration about it
/// [rad/s]. A thin rod that hangs a little beside its axis is turned about that the most of all.
double eccentric_spin(const Bodies& bodies, std::uint32_t body, const Placement& frame);

/// Force at the joint's point of a and torque on a, from b; world frame [N], [N m]. Motors,
/// springs, limits and friction of the joint are part of it. The mean of the last two substeps:
/// iterations run forwards and backwards in turn, and so does what they have not settled.
struct JointLoad {
    Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
};
JointLoad joint_load(const World& world, std::uint32_t joint);

/// Joints that leave one rotation free, by index; their angles are counted through whole turns.
std::vector<std::uint32_t> revolute_joints(const World& world);

/// Follows the angles of revolute joints; called once a substep.
void count_turns(World& world, const std::vector<std::uint32_t>& revolute);

}  // namespace plumb
