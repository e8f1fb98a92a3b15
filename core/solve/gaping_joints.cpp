// SPDX-License-Identifier: MIT
#include "solve/gaping_joints.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr double kGape = 1e-3, kGapeTurn = 0.01;  // [m], [rad]
constexpr double kGapeShare = 0.01;

bool is_along(const Joint& joint, std::uint32_t axis) {
    return axis <= kAlongZ || joint.kind == JointKind::distance;
}

/// The whole angle, where the rows that close it know its sine.
double turned(const Joint& joint, const JointPose& pose) {
    const Matrix3d &a = pose.axes_a, &b = pose.axes_b;
    const int free = free_turns(joint);
    if (free == 3 || joint.angular_compliance > 0) return 0;
    if (free == 0) {  // of the turn Σ a_k b_kᵀ
        const Vector3d twice_sine =
            b.col(0).cross(a.col(0)) + b.col(1).cross(a.col(1)) + b.col(2).cross(a.col(2));
        return std::atan2(twice_sine.norm(), a.cwiseProduct(b).sum() - 1);
    }
    int axis = 0;  // the free one of one, the locked one of two
    while (joint.locked[kTurnX + axis] != (free == 2)) ++axis;
    if (free == 1)
        return std::atan2(a.col(axis).cross(b.col(axis)).norm(), a.col(axis).dot(b.col(axis)));
    const double sine = a.col((axis + 2) % 3).dot(b.col((axis + 1) % 3));
    return std::asin(std::min(1.0, std::abs(sine)));
}

}  // namespace

JointError locked_error(const Joint& joint, const JointPose& pose) {
    return {joint.compliance > 0 ? 0 : joint_gap(joint, pose), turned(joint, pose)};
}

JointError limit_error(const World& world, const JointDrive& drive, const JointPose& pose) {
    if (drive.kind != DriveKind::limit) return {};
    const double q = joint_coordinate(world, drive.joint, drive.axis, pose).value;
    const double passed = std::max({0.0, drive.spec.lower - q, q - drive.spec.upper});
    const bool along = is_along(world.joints.joints[drive.joint], drive.axis);
    return along ? JointError{passed, 0} : JointError{0, passed};
}

double coupling_error(const World& world, const JointCoupling& c) {
    if (world.joints.joints[c.joint_a].broken || world.joints.joints[c.joint_b].broken) return 0;
    return std::abs(joint_coordinate(world, c.joint_b, c.axis_b).value -
                    c.ratio * joint_coordinate(world, c.joint_a, c.axis_a).value - c.offset);
}

JointError gaping_from(const Bodies& b, const Joint& joint) {
    double gap = kGape;
    for (const std::uint32_t body : {joint.a, joint.b})
        if (body != kNoIndex && b.bounding_radius[body] > 0)
            gap = std::min(gap, kGapeShare * 2 * b.bounding_radius[body]);
    return {gap, kGapeTurn};
}

double gaping_from(const World& world, const JointCoupling& c) {
    const auto from = [&](std::uint32_t index, std::uint32_t axis) {
        const Joint& joint = world.joints.joints[index];
        const JointError error = gaping_from(world.bodies, joint);
        return is_along(joint, axis) ? error.along : error.about;
    };
    return std::min(from(c.joint_b, c.axis_b), std::abs(c.ratio) * from(c.joint_a, c.axis_a));
}

void note_gaping_joints(const World& world, bool closed, StepReport& report) {
    GapingJoints& gaping = report.gaping;
    const auto take = [](double error, std::uint32_t index, double& worst, std::uint32_t& of) {
        if (error > worst) worst = error, of = index;
    };
    if (!closed || !world.joints.drives.empty())
        each_joint_error(world, closed, [&](std::uint32_t i, const JointError& error) {
            if (!(error.along > 0 || error.about > 0)) return;
            const JointError from = gaping_from(world.bodies, world.joints.joints[i]);
            if (error.along > from.along) take(error.along, i, gaping.along, gaping.widest);
            if (error.about > from.about) take(error.about, i, gaping.about, gaping.most_turned);
            gaping.joints += error.along > from.along || error.about > from.about;
        });
    for (std::uint32_t i = 0; i < world.joints.couplings.size(); ++i) {
        const JointCoupling& coupling = world.joints.couplings[i];
        const double error = coupling_error(world, coupling);
        if (!(error > gaping_from(world, coupling))) continue;
        take(error, i, gaping.coupled, gaping.worst_coupling);
        ++gaping.couplings;
    }
}

}  // namespace plumb
