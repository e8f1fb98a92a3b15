// SPDX-License-Identifier: MIT
/// A joint of any kind at the start of a substep, as its rows need it.
#pragma once

#include "constraints/joint_rows.h"
#include "constraints/substep_time.h"
#include "ties/joint_state.h"
#include "ties/lever_of.h"

namespace plumb {

inline InverseMass<double> inverse_mass(const Bodies& b, std::uint32_t body) {
    if (body == kNoIndex) return {0, {0, 0, 0, 0, 0, 0}};
    return {b.inverse_mass[body], b.world_inverse_inertia[body]};
}

/// What row k of a joint's response leaves while its rigid rows hold [1/kg], [1/(kg m²)].
template <class IsRigid>
inline double response_beside(const double (&response)[6][6], std::uint32_t k,
                              const IsRigid& is_rigid) {
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return response[std::max(i, j)][std::min(i, j)];
    };
    double rigid[6][6], crossed[6], solved[6];
    for (std::uint32_t i = 0; i < 6; ++i) {
        for (std::uint32_t j = 0; j < 6; ++j)
            rigid[i][j] = is_rigid(i) && is_rigid(j) ? at(i, j) : i == j;
        crossed[i] = solved[i] = is_rigid(i) ? at(i, k) : 0;
    }
    solve_ldlt<double, 6>(rigid, solved);
    double left = at(k, k);
    for (int i = 0; i < 6; ++i) left -= crossed[i] * solved[i];
    return std::max(left, 0.0);
}

/// Makes springs of the rows that have compliance.
inline void soften(JointGeometry<double>& g, const World& world, const Joint& joint,
                   const SubstepTime& time) {
    const double h = time.h;
    const Bodies& b = world.bodies;
    const auto before = [&](std::uint32_t body) -> Velocity<double> {
        if (body == kNoIndex) return {Vector3d::Zero(), Vector3d::Zero()};
        return {b.velocity_now[body], b.angular_velocity_now[body]};
    };
    const Velocity<double> rest = before(kNoIndex);
    const JointRows<double> now = joint_rows<double>(g, rest, rest, h),
                            next = joint_rows<double>(g, before(joint.a), before(joint.b), h);
    double response[6][6];
    joint_response<double>(response, now, g, inverse_mass(b, joint.a), inverse_mass(b, joint.b));
    const auto is_rigid = [&](std::uint32_t k) {
        return g.lock[k] > 0 && !(joint.compliance_of(k) > 0);
    };
    for (std::uint32_t k = 0; k < kJointAxes; ++k) {
        const double alpha = joint.compliance_of(k);
        if (!(g.lock[k] > 0) || !(alpha > 0)) continue;
        const double z = h * h * response_beside(response, k, is_rigid) / alpha;
        const SpringShares share = spring_shares(z, 0, time.part, joint.crowd);
        g.softness[k] = alpha / (time.part * share.ahead * h * h);
        g.lag[k] =
            now.c[k] * (1 - 1 / share.ahead) + share.back / share.ahead * (next.c[k] - now.c[k]);
    }
}

/// With arms that stay where they are.
inline JointGeometry<double> joint_geometry(const World& world, const Joint& joint,
                                            const SubstepTime& time) {
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
        g.lock[k] = joint.locked[k] && !joint.broken;
        g.softness[k] = g.lag[k] = 0;
    }
    g.lever_a = g.lever_b = {0, Vector3d::Zero()};
    g.length = joint.locked[kAlongX] ? joint.length : 0;
    g.line_share = 0, g.line_lag = Vector3d::Zero();
    if (joint.compliance > 0 || joint.angular_compliance > 0) soften(g, world, joint, time);
    return g;
}

/// What of a joint's old errors is left for later [m], [rad]: what is closed of them in a substep
/// is bounded by `most`, as old overlap is. What a compliant row has stretched is no error. `old`:
/// those errors, whole.
inline void defer_errors(double (&deferred)[6], double (&old)[6], const JointGeometry<double>& g,
                         double most) {
    double c[6];
    joint_errors<double>(c, g, JointPreview<double>(g));
    double squared[2] = {0, 0};
    for (int k = 0; k < 6; ++k) {
        old[k] = g.lock[k] > 0 && !(g.softness[k] > 0) ? c[k] : 0;
        squared[k / 3] += old[k] * old[k];
    }
    for (int k = 0; k < 6; ++k)
        deferred[k] = old[k] * deferred_fraction<double>(squared[k / 3], most);
}

/// With levers that turn as the joint's load asks for.
inline JointGeometry<double> loaded_joint_geometry(const World& world, const Joint& joint,
                                                   JointSolve solve, const SubstepTime& time) {
    const double h = time.h;
    JointGeometry<double> g = joint_geometry(world, joint, time);
    g.lever_a = lever_of(world, joint, joint.a, g.r_a, solve, h);
    g.lever_b = lever_of(world, joint, joint.b, g.r_b, solve, h);
    if (g.length > 0) turn_line(g, world, joint, solve, h);
    return g;
}

}  // namespace plumb
