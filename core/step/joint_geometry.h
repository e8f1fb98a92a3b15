// SPDX-License-Identifier: MIT
/// A joint of any kind at the start of a substep, as its rows need it.
#pragma once

#include "constraints/joint_rows.h"
#include "step/joint_state.h"
#include "step/lever_of.h"

namespace plumb {

/// With arms that stay where they are; h: substep [s].
inline JointGeometry<double> joint_geometry(const World& world, const Joint& joint, double h) {
    const Bodies& b = world.bodies;
    const JointPose pose = joint_pose(b, joint);
    JointGeometry<double> g;
    g.r_a = pose.point_a - pose.centre_a;
    g.r_b = Vector3d::Zero();
    if (joint.b != kNoIndex) g.r_b = pose.point_b - pose.centre_b;
    g.apart = pose.point_a - pose.point_b;
    for (int k = 0; k < 3; ++k) {
        g.e[k] = pose.axes_b.col(k);
        g.u[k] = b.orientation[joint.a] * joint.turns[k].u;
        g.w[k] = joint.turns[k].w;
        if (joint.b != kNoIndex) g.w[k] = b.orientation[joint.b] * g.w[k];
    }
    for (std::uint32_t k = 0; k < kJointAxes; ++k) {
        const double alpha = k < kTurnX ? joint.compliance : joint.angular_compliance;
        g.lock[k] = joint.locked[k] && !joint.broken;
        g.softness[k] = alpha / (h * h);
    }
    g.lever_a = g.lever_b = {0, Vector3d::Zero()};
    g.length = joint.locked[kAlongX] ? joint.length : 0;
    g.line_share = 0, g.line_lag = Vector3d::Zero();
    return g;
}

/// With levers that turn as the joint's load asks for.
inline JointGeometry<double> loaded_joint_geometry(const World& world, const Joint& joint,
                                                   JointSolve solve, double h) {
    JointGeometry<double> g = joint_geometry(world, joint, h);
    g.lever_a = lever_of(world, joint, joint.a, g.r_a, solve, h);
    g.lever_b = lever_of(world, joint, joint.b, g.r_b, solve, h);
    if (g.length > 0) turn_line(g, world, joint, solve, h);
    return g;
}

}  // namespace plumb
