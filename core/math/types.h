// SPDX-License-Identifier: MIT
/// Vectors over any number type, and the way between the contract's plain values and Eigen's.
#pragma once

#include <plumb/shape.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plumb {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
using Vector3d = Eigen::Vector3d;
using Matrix3d = Eigen::Matrix3d;
using Quaterniond = Eigen::Quaterniond;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// a · b and a × b with one fixed order of operations, the same for scalars and lanes.
template <class T>
inline T dot(const Vector3<T>& a, const Vector3<T>& b) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}
template <class T>
inline Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
    return Vector3<T>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]);
}

inline Vector3d to_eigen(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Quaterniond to_eigen(const Quat& q) { return {q.w, q.x, q.y, q.z}; }
inline Vec3 to_plain(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Quat to_plain(const Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

}  // namespace plumb
