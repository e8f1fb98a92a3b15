// SPDX-License-Identifier: MIT
#include "solve/joint_residual.h"

#include "ties/joint_geometry.h"
#include "ties/joint_state.h"

#include <cmath>

namespace plumb {
namespace {

/// The locked translations: unit directions, and how far they are open [m]; 0 of others.
struct OpenRows {
    Matrix3d along;
    Vector3d lock, open;
};

OpenRows open_rows(const Joint& joint, const JointPose& pose) {
    const Vector3d apart = pose.point_a - pose.point_b;
    OpenRows rows{pose.axes_b, Vector3d::Zero(), Vector3d::Zero()};
    for (std::uint32_t k = 0; k < 3; ++k)
        if (joint.locked[k] && !joint.broken && !(joint.compliance_of(k) > 0)) rows.lock[k] = 1;
    rows.open = rows.lock.cwiseProduct(pose.axes_b.transpose() * apart);
    const double distance = apart.norm();
    if (joint.length > 0 && distance > 0) {
        rows.along.col(kAlongX) = apart / distance;
        rows.open[kAlongX] = rows.lock[kAlongX] * (distance - joint.length);
    }
    return rows;
}

}  // namespace

ResidualSum open_residual(const World& world, const Joint& joint, double h) {
    const JointPose pose = joint_pose(world.bodies, joint);
    const OpenRows rows = open_rows(joint, pose);
    const InverseMass<double> of_a = inverse_mass(world.bodies, joint.a),
                              of_b = inverse_mass(world.bodies, joint.b);
    const Vector3d arm_a = pose.point_a - pose.centre_a, arm_b = pose.point_b - pose.centre_b;
    const auto k = [&](int i, int j) {
        const Vector3d d = rows.along.col(i), e = rows.along.col(j);
        const double entry =
            response<double>(of_a, arm_a, d, e) + response<double>(of_b, arm_b, d, e);
        return rows.lock[i] * rows.lock[j] * entry + (i == j ? 1 - rows.lock[i] : 0);
    };
    const Symmetric3<double> all{k(0, 0), k(1, 1), k(2, 2), k(0, 1), k(0, 2), k(1, 2)};
    const double impulse = solve_ldlt<double>(all, rows.open / h).squaredNorm();
    return {impulse, impulse, rows.open.squaredNorm() / (h * h), 0, 1};
}

}  // namespace plumb
