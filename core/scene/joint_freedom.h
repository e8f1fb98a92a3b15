// SPDX-License-Identifier: MIT
/// Which of its axes a joint takes away, and which of the others it has coordinates on.
#pragma once

#include "scene/joint.h"

#include <cmath>
#include <iterator>

namespace plumb {

using JointAxes = std::array<bool, kJointAxes>;

/// The rows that each kind takes away, in the order of JointKind.
inline constexpr JointAxes kLocked[] = {
    {true, true, true, false, false, false},     // ball
    {false, true, true, false, false, false},    // point_on_line
    {true, false, false, false, false, false},   // point_on_plane
    {false, false, false, true, true, true},     // orientation
    {false, false, false, false, true, true},    // parallel
    {false, false, false, false, false, true},   // perpendicular
    {true, true, true, true, true, true},        // fixed
    {true, true, true, false, true, true},       // hinge
    {true, true, true, false, false, true},      // universal
    {false, true, true, true, true, true},       // slider
    {false, true, true, false, true, true},      // cylindrical
    {true, false, false, false, true, true},     // planar
    {true, false, false, false, false, false},   // distance, along the line between the anchors
    {true, true, true, false, false, false},     // cone_twist
    {false, false, false, false, false, false},  // six_axis: as the scene says
};

inline bool is_known(JointKind kind) { return static_cast<std::size_t>(kind) < std::size(kLocked); }

/// What a joint of a known kind takes away. A distance that has limits or a spring is held by them,
/// as a rope is.
inline JointAxes locked_axes(const JointSpec& joint) {
    if (joint.kind == JointKind::six_axis) return joint.locked;
    JointAxes locked = kLocked[static_cast<std::size_t>(joint.kind)];
    const JointAxisSpec& x = joint.axes[kAlongX];
    if (joint.kind == JointKind::distance)
        locked[kAlongX] = !std::isfinite(x.lower) && !std::isfinite(x.upper) && !(x.stiffness > 0);
    return locked;
}

/// Whether joints of a kind can have a coordinate on an axis: a distance is one number, and a
/// cone-and-twist has its swing for two rotations.
inline bool has_coordinate(JointKind kind, std::uint32_t axis) {
    if (kind == JointKind::distance) return axis == kAlongX;
    if (kind == JointKind::cone_twist) return axis == kTurnX || axis == kTurnY;
    return axis < kJointAxes;
}

/// Whether a joint can move along or about an axis, and tell where it stands there.
inline bool is_free(const JointSpec& joint, std::uint32_t axis) {
    return has_coordinate(joint.kind, axis) && !locked_axes(joint)[axis];
}

/// A distance and a swing have a size and no direction.
inline bool is_never_negative(JointKind kind, std::uint32_t axis) {
    return (kind == JointKind::distance && axis == kAlongX) ||
           (kind == JointKind::cone_twist && axis == kTurnY);
}

}  // namespace plumb
