// SPDX-License-Identifier: MIT
/// Joints as the user writes them.
///
/// A joint has a frame: its origin is the anchor, its x axis the joint's axis (of a hinge, a
/// slider, a point on a line; the normal of a plane; the bone of a cone-and-twist). Both bodies
/// carry a copy of it, which coincide at the start. Along and about each of the frame's axes the
/// joint is locked, free, or bounded by a limit.
#pragma once

#include "scene/geometry.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

/// What a joint takes away, by rows: translations along x y z, rotations about x y z.
enum class JointKind : std::uint32_t {
    ball,            ///< 3 + 0: one common point
    point_on_line,   ///< 2 + 0: a's point stays on b's line along x
    point_on_plane,  ///< 1 + 0: a's point stays in b's plane across x
    orientation,     ///< 0 + 3: the bodies turn as one
    parallel,        ///< 0 + 2: the x axes stay parallel
    perpendicular,   ///< 0 + 1: b's x axis and a's y axis stay perpendicular
    fixed,           ///< 3 + 3
    hinge,           ///< 3 + 2: turns about x
    universal,       ///< 3 + 1: turns about b's x and a's y
    slider,          ///< 2 + 3: moves along x
    cylindrical,     ///< 2 + 2: moves along x and turns about it
    planar,          ///< 1 + 2: moves across x and turns about it
    distance,        ///< the two anchors keep their distance, or stay within its limits
    cone_twist,      ///< 3 + 0: a ball whose x axes part by at most the swing limit
    six_axis,        ///< as `locked` says
};

/// The axes of a joint: x y z along, then x y z about. Of a cone-and-twist `kTurnX` is the twist
/// about the bone, and `kTurnY` the swing away from it, which is never negative.
enum JointAxis : std::uint32_t { kAlongX, kAlongY, kAlongZ, kTurnX, kTurnY, kTurnZ };
inline constexpr std::uint32_t kJointAxes = 6;

/// A value that changes with time: linear between keys, held before the first and after the last.
struct ValueKey {
    double time = 0, value = 0;  ///< [s]; [m], [rad], [m/s] or [rad/s]
};

enum class MotorMode : std::uint32_t { none, velocity, position };

/// What drives a joint along or about one of its axes. Along: [m], [N]; about: [rad], [N m].
struct JointMotor {
    MotorMode mode = MotorMode::none;
    double target = 0;           ///< [m/s], [rad/s]; [m], [rad]
    std::vector<ValueKey> keys;  ///< where there are any, they stand for `target`
    double greatest =
        std::numeric_limits<double>::infinity();  ///< force or torque is never larger [N], [N m]
    double frequency = 5;                         ///< of a position motor's response [Hz]
    double damping_ratio = 1;                     ///< of the same; 1: no overshoot
};

/// What acts along or about one axis that the joint leaves free.
struct JointAxisSpec {
    double lower = -std::numeric_limits<double>::infinity();  ///< limits [m], [rad]
    double upper = std::numeric_limits<double>::infinity();
    JointMotor motor;
    double stiffness = 0;  ///< of a spring [N/m], [N m/rad]
    double rest = 0;       ///< where the spring is at ease [m], [rad]
    double damping = 0;    ///< [N s/m], [N m s/rad]
    double friction = 0;   ///< greatest force or torque of dry friction [N], [N m]
    double greatest_speed =
        std::numeric_limits<double>::infinity();  ///< to either side [m/s], [rad/s]
};

/// A joint between two bodies, or a body and the world (body_b = kNoIndex).
struct JointSpec {
    std::string name;
    JointKind kind = JointKind::ball;
    std::uint32_t body_a = kNoIndex, body_b = kNoIndex;  ///< indices into Scene::bodies
    Eigen::Vector3d anchor =
        Eigen::Vector3d::Zero();              ///< common point at the start, world frame [m]
    std::optional<Eigen::Vector3d> anchor_b;  ///< of a distance joint: its other end [m]
    Eigen::Quaterniond frame =
        Eigen::Quaterniond::Identity();            ///< joint frame → world, at the start
    std::array<bool, kJointAxes> locked{};         ///< of a six_axis joint
    std::array<JointAxisSpec, kJointAxes> axes{};  ///< of axes that are not locked
    double compliance = 0;                         ///< of the locked translations [m/N]
    double angular_compliance = 0;                 ///< of the locked rotations [rad/(N m)]
    double breaking_force = std::numeric_limits<double>::infinity();   ///< [N]
    double breaking_torque = std::numeric_limits<double>::infinity();  ///< [N m]
    bool collide = false;  ///< whether the linked bodies collide with each other
};

/// Two joints' coordinates tied together: q_b = ratio q_a + offset. Of hinges a gear, of a hinge
/// and a slider rack and pinion [m/rad], of any a mimic.
struct CouplingSpec {
    std::string name;
    std::uint32_t joint_a = kNoIndex, joint_b = kNoIndex;  ///< indices into Scene::joints
    std::uint32_t axis_a = kTurnX, axis_b = kTurnX;        ///< JointAxis
    double ratio = 1;
    std::optional<double> offset;  ///< else as the joints stand at the start
};

}  // namespace plumb
