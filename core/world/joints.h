// SPDX-License-Identifier: MIT
/// Joints as the step sees them.
///
/// A joint's frame rides on both bodies, and what the joint takes away is up to six rows:
///
///   along k  C = e_k · (p_a − p_b)   e_k an axis of b's copy of the frame, p the two anchors
///   about k  C = u_k · w_k           u_k rides on a, w_k on b, and they are to stay perpendicular
#pragma once

#include "math/types.h"
#include "scene/joint.h"
#include "world/island_rest.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace plumb {

/// Two directions that a rotational row keeps perpendicular, each in its body's frame.
struct PerpendicularPair {
    Vector3d u = Vector3d::Zero(), w = Vector3d::Zero();
};

/// Between which limits a joint's turn about an axis stays [rad].
struct TurnRange {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
};

/// Into how many parts a tree of joints divides its substeps; kept by the first joint of the tree.
struct TreePace {
    std::uint32_t parts = 0;   ///< of this substep; 0: the tree is solved among the others
    std::uint32_t before = 0;  ///< of the substep before
    std::uint32_t calm = 0;    ///< for how many substeps fewer would have done

    /// Whether the tree is advanced by itself: it is also in the first substep that is whole again,
    /// since its velocity is that of the middle of a part.
    bool is_divided() const { return parts > 0 || before > 1; }
};

struct Joint {
    std::uint32_t id = 0;  ///< what the joint is called as long as it lives; grows along the table
    JointKind kind = JointKind::ball;
    std::uint32_t a = kNoIndex, b = kNoIndex;  ///< bodies; b may be kNoIndex: the world
    Placement frame_a, frame_b;  ///< joint frame → body; → world where b is kNoIndex
    std::array<bool, kJointAxes> locked{};
    std::array<PerpendicularPair, 3> turns{};        ///< of the locked rotations about x y z
    std::array<TurnRange, 3> ranges{};               ///< of the free ones
    double length = 0;                               ///< that a distance joint keeps [m]
    double compliance = 0, angular_compliance = 0;   ///< [m/N], [rad/(N m)]
    double breaking_force = 0, breaking_torque = 0;  ///< [N], [N m]
    bool broken = false;                             ///< a broken joint acts no more
    bool keeps_apart = false;                        ///< its bodies do not collide with each other
    std::uint32_t crowd = 0;  ///< springs on one of its bodies, its own among them, at the most
    std::array<double, kJointAxes> rows{};  ///< impulses of the last substep [N s], [N m s]; of a
                                            ///< plain ball along the world's axes
    std::array<double, kJointAxes> rows_before{};  ///< and of the one before it
    TreePace pace;
    IslandRest island_rest;
    double owed = 0;  ///< its share of the energy lent to its island [J] (solve/energy_loan.h)

    /// Of a row that is taken away [m/N], [rad/(N m)].
    double compliance_of(std::uint32_t axis) const {
        return axis < kTurnX ? compliance : angular_compliance;
    }

    /// Solved by the kernel for one common point, which is quicker.
    bool is_plain_ball() const {
        return kind == JointKind::ball && compliance == 0 && !std::isfinite(breaking_force) &&
               !std::isfinite(breaking_torque);
    }
};

enum class DriveKind : std::uint32_t { limit, motor, spring, friction, speed };

/// One row along or about an axis that a joint leaves free.
struct JointDrive {
    std::uint32_t joint = 0, axis = 0;  ///< index into JointTable::joints; JointAxis
    DriveKind kind = DriveKind::limit;
    JointAxisSpec spec;
    double impulse = 0;         ///< of the last substep [N s], [N m s]
    double impulse_before = 0;  ///< and of the one before it
    double axis_impulse = 0;  ///< of all drives of its axis in a tree, which their sum may miss by
                              ///< a bit

    /// Whether it pulls as a spring does.
    bool is_spring() const {
        return kind == DriveKind::spring ||
               (kind == DriveKind::motor && spec.motor.mode == MotorMode::position);
    }
};

/// q_b = ratio q_a + offset.
struct JointCoupling {
    std::uint32_t id = 0;  ///< as Joint::id
    std::uint32_t joint_a = 0, joint_b = 0, axis_a = 0, axis_b = 0;
    double ratio = 1, offset = 0;
    double impulse = 0;   ///< of the last substep, along q_b [N s], [N m s]
    double deferred = 0;  ///< part of q_b − ratio q_a − offset that goes slowly [m], [rad]
};

struct JointTable {
    std::vector<Joint> joints;
    std::vector<double> turn;  ///< of each joint about its one free axis, counted through whole
                               ///< turns [rad]; 0 where there is none
    std::vector<JointDrive> drives;  ///< by joint, then axis
    std::vector<JointCoupling> couplings;
    std::uint32_t next_id = 0, next_coupling_id = 0;  ///< of those that come
    std::size_t size() const { return joints.size(); }
};

}  // namespace plumb
