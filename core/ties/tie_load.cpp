// SPDX-License-Identifier: MIT
#include "ties/tie_load.h"

#include "constraints/joint_lever.h"
#include "ties/joint_state.h"
#include "ties/linked_point.h"

#include <algorithm>

namespace plumb {
namespace {

/// An arm that is none [m].
constexpr double kNoArm = 1e-15;

/// What a joint bore along its axes in the substep before, on its a [N s].
Vector3d impulse_on_a(const World& world, const Joint& joint) {
    const Vector3d along(joint.rows[kAlongX], joint.rows[kAlongY], joint.rows[kAlongZ]);
    if (joint.is_plain_ball()) return along;
    const JointPose pose = joint_pose(world.bodies, joint);
    if (joint.length > 0) return along[0] * (pose.point_a - pose.point_b).normalized();
    return pose.axes_b * along;
}

/// The square of h ω of a body that a joint pulls at its lever; what pushes it there swings
/// nothing, nor what a joint does not let turn. `impulse`: on the body; `frame`: of the joint on
/// the body.
double pull_load(const World& world, const Joint& joint, std::uint32_t body, const Placement& frame,
                 Vector3d impulse, double h) {
    const Bodies& b = world.bodies;
    const int free = free_turns(joint);
    if (free == 0) return 0;
    Vector3d arm = b.orientation[body] * frame.position;
    Symmetric3<double> inverse_inertia = b.world_inverse_inertia[body];
    if (free == 1) {
        int axis = 0;
        while (joint.locked[kTurnX + axis]) ++axis;
        const Vector3d about = b.orientation[body] * (frame.rotation * Vector3d::Unit(axis));
        const double turns = about.dot(Vector3d(inverse_inertia * about));
        arm -= about.dot(arm) * about, impulse -= about.dot(impulse) * about;
        return h * turns * std::max(0.0, impulse.dot(arm));
    }
    const double pull = std::max(0.0, impulse.dot(arm) / std::max(arm.norm(), kNoArm));
    return lever_load<double>(pull, 0, arm, inverse_inertia, h);
}

}  // namespace

TieLoad load_of(const World& world, const Joint& joint, double h) {
    const Bodies& b = world.bodies;
    const Vector3d impulse = impulse_on_a(world, joint);
    TieLoad load;
    const auto see = [&](std::uint32_t body, const Placement& frame, double sign) {
        if (body == kNoIndex || b.motion[body] != Motion::dynamic) return;
        load.turn = std::max(load.turn, h * angular_rate(b, joint, body, frame));
        load.pull = std::max(load.pull, pull_load(world, joint, body, frame, sign * impulse, h));
    };
    see(joint.a, joint.frame_a, 1), see(joint.b, joint.frame_b, -1);
    return load;
}

TieLoad load_of(const World& world, const Link& link, double h) {
    const Bodies& b = world.bodies;
    const LinkedPoint at_a = linked_point(world, link.a), at_b = linked_point(world, link.b);
    TieLoad load{0, link_load(link, at_a, at_b, h)};
    const auto see = [&](std::uint32_t body, const LinkedPoint& at) {
        if (body == kNoIndex || b.motion[body] != Motion::dynamic) return;
        const double arm = std::max(at.arm.norm(), kNoArm);
        load.turn = std::max(load.turn, h * b.angular_velocity[body].cross(at.arm).norm() / arm);
        load.pull = std::max(load.pull, lever_load<double>(link.impulse.norm(), 0, at.arm,
                                                           b.world_inverse_inertia[body], h));
    };
    see(link.a.body, at_a), see(link.b.body, at_b);
    return load;
}

}  // namespace plumb
