// SPDX-License-Identifier: MIT
/// Frames from directions.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plumb::reader {

/// Length below which a vector has no direction.
inline constexpr double kShortestDirection = 1e-9;

inline bool has_direction(const Eigen::Vector3d& v) { return v.norm() >= kShortestDirection; }

/// Of two vectors that have directions.
inline bool are_parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.normalized().cross(b.normalized()).norm() < 1e-6;
}

/// A direction that is far from parallel to the unit vector x: the world's axis, the first of
/// them, along which x is shortest.
inline Eigen::Vector3d any_across(const Eigen::Vector3d& x) {
    int axis = 0;
    x.cwiseAbs().minCoeff(&axis);
    return Eigen::Vector3d::Unit(axis);
}

/// The frame whose x axis is the unit vector x and whose y axis is what of y is perpendicular to
/// it; the two are not parallel. Frame → world.
inline Eigen::Quaterniond frame_of(const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
    Eigen::Matrix3d axes;
    axes.col(0) = x;
    axes.col(2) = x.cross(y.normalized()).normalized();
    axes.col(1) = axes.col(2).cross(x);
    return Eigen::Quaterniond(axes).normalized();
}

}  // namespace plumb::reader
