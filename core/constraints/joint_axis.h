// SPDX-License-Identifier: MIT
/// A joint's coordinates: how far it has moved along or turned about an axis, and the row by which
/// the bodies' velocities change that.
///
///   rate = e · (v_a − v_b) + g_a · ω_a − g_b · ω_b
///
/// Along: q = e_k · (p_a − p_b) with e_k riding on b, so e = e_k, g_a = r_a × e, and on b the same
/// impulse acts at the same point p_a, g_b = (p_a − x_b) × e. About: e = 0 and g_a = g_b = g, for a
/// joint only feels how the bodies turn against each other. One free axis: the whole angle about
/// it. Two, with the third locked: R_bᵀ R_a is a turn about an axis of b and then one about an axis
/// of a. Three: R_bᵀ R_a = R_x(α) R_y(β) R_z(γ), whose rates are ω · (the dual basis of the three
/// axes x_b, y′, z_a). Cone and twist: R = swing · twist about x (§5 names neither).
///
/// The same pose has many angles: whole turns more or less, and of three angles also α + π, π − β,
/// γ + π. They go from −π to π; but between limits those count that are the least outside of them:
/// a joint that may turn from 0 to 3 about an axis and has turned by 3.3 is 0.3 too far, not 2.98
/// short of 0. One limit alone tells nothing, for each angle is beyond it but for whole turns.
#pragma once

#include "math/rotation.h"
#include "world/joints.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumb {

/// Where a joint's two frames and the bodies' centres of mass are.
struct JointPose {
    Vector3d point_a, point_b;    ///< anchors, world frame [m]
    Matrix3d axes_a, axes_b;      ///< columns: the frames' axes, world frame
    Vector3d centre_a, centre_b;  ///< [m]
};

struct JointCoordinate {
    double value = 0;  ///< [m], [rad]
    Vector3d along = Vector3d::Zero(), turn_a = Vector3d::Zero(), turn_b = Vector3d::Zero();
};

/// Along e, which rides on b.
inline JointCoordinate coordinate_along(const JointPose& p, const Vector3d& e) {
    const Vector3d apart = p.point_a - p.point_b;
    return {e.dot(apart), e, (p.point_a - p.centre_a).cross(e), (p.point_a - p.centre_b).cross(e)};
}

/// Between the two anchors.
inline JointCoordinate coordinate_distance(const JointPose& p) {
    const Vector3d apart = p.point_a - p.point_b;
    const double length = apart.norm();
    JointCoordinate q =
        coordinate_along(p, length > 0 ? Vector3d(apart / length) : p.axes_b.col(0));
    q.value = length;
    return q;
}

inline constexpr double kHalfTurn = 3.141592653589793;  ///< [rad]

/// The angle from −π to π of a sine and a cosine.
inline double full_angle(double sine, double cosine) {
    const double first = angle_of(std::abs(sine), std::abs(cosine));
    const double upper = cosine < 0 ? kHalfTurn - first : first;
    return sine < 0 ? -upper : upper;
}

/// About axis k, the only one that is free.
inline JointCoordinate coordinate_about(const JointPose& p, int k) {
    const Vector3d axis = p.axes_b.col(k);
    const Vector3d across = p.axes_a.col((k + 1) % 3);
    return {
        full_angle(across.dot(p.axes_b.col((k + 2) % 3)), across.dot(p.axes_b.col((k + 1) % 3))),
        Vector3d::Zero(), axis, axis};
}

/// About axis k, where the turn about `locked` is the only one that is not free: the bodies turn
/// about the axis of b that follows it, then about the remaining one of a. The first angle is that
/// of the latter axis as b sees it, the second that of the former as a does.
inline JointCoordinate coordinate_of_two(const JointPose& p, int locked, int k) {
    const int next = (locked + 1) % 3, last = (locked + 2) % 3;
    const bool first = k == next;
    const Vector3d seen = first ? p.axes_a.col(last) : p.axes_b.col(next);
    const Matrix3d& from = first ? p.axes_b : p.axes_a;
    const Vector3d cosine = from.col(first ? last : next), sine = from.col(locked);
    const double c = cosine.dot(seen), s = sine.dot(seen);
    const Vector3d turn = seen.cross(Vector3d(c * sine - s * cosine)) *
                          ((first ? 1 : -1) / std::max(c * c + s * s, 1e-9));
    return {full_angle(s, c), Vector3d::Zero(), turn, turn};
}

inline bool has_both(const TurnRange& range) {
    return std::isfinite(range.lower) && std::isfinite(range.upper);
}

/// Of an angle and what is whole turns beside it: the one that is the least outside of a range.
inline double angle_within(const TurnRange& range, double angle) {
    if (!has_both(range)) return angle;
    const double middle = 0.5 * (range.lower + range.upper);
    return angle + 2 * kHalfTurn * std::round((middle - angle) / (2 * kHalfTurn));
}

using EulerAngles = std::array<double, 3>;  ///< α, β, γ
using TurnRanges = std::array<TurnRange, 3>;

/// Each angle where it is the least outside of its range, if that has two ends; by how much they
/// are so altogether [rad].
inline double bring_within(const TurnRanges& ranges, EulerAngles& angles) {
    double outside = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const TurnRange& range = ranges[k];
        if (!has_both(range)) continue;
        double& q = angles[k];
        q = angle_within(range, q);
        outside += std::max({0.0, range.lower - q, q - range.upper});
    }
    return outside;
}

/// α, β or γ (k = 0, 1, 2) of R_bᵀ R_a = R_x(α) R_y(β) R_z(γ).
inline JointCoordinate coordinate_euler(const JointPose& p, int k, const TurnRanges& ranges = {}) {
    const Matrix3d r = p.axes_b.transpose() * p.axes_a;
    const double sine = std::clamp(r(0, 2), -1.0, 1.0);
    const double cosine = std::sqrt(r(0, 0) * r(0, 0) + r(0, 1) * r(0, 1));
    EulerAngles angles = {full_angle(-r(1, 2), r(2, 2)), full_angle(sine, cosine),
                          full_angle(-r(0, 1), r(0, 0))};
    const auto wrapped = [](double q) { return angle_within({-kHalfTurn, kHalfTurn}, q); };
    EulerAngles over = {wrapped(angles[0] + kHalfTurn), wrapped(kHalfTurn - angles[1]),
                        wrapped(angles[2] + kHalfTurn)};
    const double outside = bring_within(ranges, angles);
    const bool is_over = bring_within(ranges, over) < outside;
    const Vector3d first = p.axes_b.col(0), last = p.axes_a.col(2);
    const Vector3d middle = last.cross(first).normalized();
    // Where first and last fall together the outer two angles are one, and only their sum counts.
    const Vector3d axes[3] = {first, middle, last};
    Vector3d dual = axes[(k + 1) % 3].cross(axes[(k + 2) % 3]);
    const double volume = axes[k].dot(dual);
    dual = volume > 1e-3 ? Vector3d(dual / volume) : axes[k];
    if (!is_over) return {angles[k], Vector3d::Zero(), dual, dual};
    if (k == 1) dual = -dual;
    return {over[k], Vector3d::Zero(), dual, dual};
}

/// The twist about the x axes of a cone-and-twist, from −π to π.
inline JointCoordinate coordinate_twist(const JointPose& p) {
    const Quaterniond q(Matrix3d(p.axes_b.transpose() * p.axes_a));
    const double sign = q.w() < 0 ? -1 : 1;
    const Vector3d sum = p.axes_a.col(0) + p.axes_b.col(0);
    const double squared = sum.squaredNorm();
    // x_a + x_b over 1 + x_a · x_b; a swing of half a turn has no twist
    const Vector3d turn = squared > 1e-9 ? Vector3d(sum * (2 / squared)) : Vector3d::Zero();
    return {2 * full_angle(sign * q.x(), sign * q.w()), Vector3d::Zero(), turn, turn};
}

/// The angle between the x axes, from 0 to π.
inline JointCoordinate coordinate_swing(const JointPose& p) {
    const Vector3d across = p.axes_b.col(0).cross(p.axes_a.col(0));
    const double sine = across.norm(), cosine = p.axes_a.col(0).dot(p.axes_b.col(0));
    const Vector3d turn = sine > 1e-9 ? Vector3d(across / sine) : p.axes_b.col(1);
    return {full_angle(sine, cosine), Vector3d::Zero(), turn, turn};
}

/// The coordinate of a joint along or about an axis that it leaves free; of a single turn without
/// whole ones.
inline JointCoordinate joint_coordinate(const Joint& joint, const JointPose& p,
                                        std::uint32_t axis) {
    if (joint.kind == JointKind::distance) return coordinate_distance(p);
    if (axis <= kAlongZ) return coordinate_along(p, p.axes_b.col(axis));
    const int k = static_cast<int>(axis - kTurnX);
    const auto within = [&](JointCoordinate q) {
        q.value = angle_within(joint.ranges[axis - kTurnX], q.value);
        return q;
    };
    if (joint.kind == JointKind::cone_twist)
        return k == 0 ? within(coordinate_twist(p)) : coordinate_swing(p);
    int count = 0, which = 0;  // of the turns that are locked
    for (int i = 0; i < 3; ++i)
        if (joint.locked[kTurnX + i]) ++count, which = i;
    if (count == 2) return coordinate_about(p, k);
    return count == 1 ? within(coordinate_of_two(p, which, k))
                      : coordinate_euler(p, k, joint.ranges);
}

}  // namespace plumb
