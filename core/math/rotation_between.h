// SPDX-License-Identifier: MIT
/// The shortest turn of one direction into another.
#pragma once

#include <Eigen/Geometry>

namespace plumb {

/// The rotation by the least angle that turns `from` into the direction of `to`; half a turn about
/// some axis across where they are opposite. Neither may be zero. (Eigen's FromTwoVectors does the
/// same by a singular value decomposition, which costs seconds of compilation in each file.)
inline Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d a = from.normalized();
    const Eigen::Vector3d sum = a + to.normalized();
    constexpr double kOpposite = 1e-8;  // a shorter sum has lost half of its digits
    const Eigen::Vector3d half = sum.norm() > kOpposite ? sum.normalized() : a.unitOrthogonal();
    Eigen::Quaterniond turn;
    turn.w() = a.dot(half);
    turn.vec() = a.cross(half);
    return turn;
}

}  // namespace plumb
