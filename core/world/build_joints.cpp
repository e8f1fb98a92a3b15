// SPDX-License-Identifier: MIT
#include "world/build_joints.h"

#include "scene/error.h"
#include "scene/joint_faults.h"
#include "world/sleep.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

namespace plumb {
namespace {

/// "turn_x".
const char* axis_name(JointKind kind, std::uint32_t axis) {
    static constexpr const char* names[] = {"x", "y", "z", "turn_x", "turn_y", "turn_z"};
    if (kind == JointKind::cone_twist && axis == kTurnX) return "twist";
    if (kind == JointKind::cone_twist && axis == kTurnY) return "swing";
    return names[axis];
}

/// How far a point may be from a body's centre of mass, in radii of gyration. Of the point's
/// inertia the body's mass is then 1e-10, of which double has six digits and single none, so
/// iterations in single still hold the point to a millionth of the arm.
constexpr double kLongestLever = 1e5;

/// An arm [m] in radii of gyration about the axis by which the body yields most: √(m λ) for the
/// greatest λ of [r]ᵀ I⁻¹ [r].
double lever_of(const Vector3d& arm, double mass, const Vector3d& inertia) {
    Matrix3d turn;
    turn << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    const Matrix3d yield = turn.transpose() * inertia.cwiseInverse().asDiagonal() * turn;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(yield, Eigen::EigenvaluesOnly);
    return std::sqrt(mass * std::max(solver.eigenvalues()[2], 0.0));
}

class Builder {
public:
    Builder(const World& world, const JointSpec& spec, const std::string& pointer)
        : world_(world), spec_(spec), pointer_(pointer) {}

    JointDraft make() {
        check_spec();
        check_bodies();
        JointDraft draft;
        Joint& joint = draft.joint;
        joint.kind = spec_.kind;
        joint.a = spec_.body_a, joint.b = spec_.body_b;
        joint.locked = locked_axes(spec_);
        for (std::size_t k = 0; k < 3; ++k)
            joint.ranges[k] = {spec_.axes[kTurnX + k].lower, spec_.axes[kTurnX + k].upper};
        joint.frame_a = in_body(joint.a, spec_.anchor);
        joint.frame_b = in_body(joint.b, spec_.anchor_b.value_or(spec_.anchor));
        check_lever(joint, joint.a, joint.frame_a.position);
        check_lever(joint, joint.b, joint.frame_b.position);
        joint.compliance = spec_.compliance, joint.angular_compliance = spec_.angular_compliance;
        joint.breaking_force = spec_.breaking_force, joint.breaking_torque = spec_.breaking_torque;
        set_length(joint);
        set_turns(joint);
        joint.keeps_apart = spec_.body_b != kNoIndex && !spec_.collide;
        add_drives(draft);
        return draft;
    }

private:
    [[noreturn]] void refuse(const std::string& key, const std::string& sentence) const {
        throw SceneError("", pointer_ + key, sentence);
    }

    void check_bodies() const {
        const Bodies& b = world_.bodies;
        if (spec_.body_a >= b.size() || (spec_.body_b != kNoIndex && spec_.body_b >= b.size()) ||
            spec_.body_a == spec_.body_b)
            refuse("/bodies", "a joint links two different bodies, or one body and the world");
        auto dynamic = [&](std::uint32_t k) { return k != kNoIndex && is_movable(b.motion[k]); };
        if (!dynamic(spec_.body_a) && !dynamic(spec_.body_b))
            refuse("/bodies", "at least one of the linked bodies must be dynamic");
    }

    void check_spec() const {
        const std::optional<JointFault> fault = find_fault(spec_);
        if (!fault) return;
        const std::string axis = fault->axis < kJointAxes
                                     ? std::string("/axes/") + axis_name(spec_.kind, fault->axis)
                                     : "";
        refuse(axis + (fault->key.empty() ? "" : "/" + fault->key), fault->sentence);
    }

    Placement in_body(std::uint32_t body, const Vector3d& anchor) const {
        if (body == kNoIndex) return {anchor, spec_.frame};
        const Quaterniond back = world_.bodies.orientation[body].conjugate();
        return {back * (anchor - world_.bodies.position[body]), (back * spec_.frame).normalized()};
    }

    /// A joint that holds a point far outside of a body feels little of its mass beside its
    /// inertia.
    void check_lever(const Joint& joint, std::uint32_t body, const Vector3d& arm) const {
        const bool holds = joint.locked[kAlongX] || joint.locked[kAlongY] || joint.locked[kAlongZ];
        if (body == kNoIndex || !is_movable(world_.bodies.motion[body]) || !holds) return;
        const double lever = lever_of(arm, world_.bodies.mass[body], world_.bodies.inertia[body]);
        if (lever <= kLongestLever) return;
        char numbers[64];
        std::snprintf(numbers, sizeof numbers, "%.3g m away, %.3g times", arm.norm(), lever);
        refuse(body == joint.b && spec_.anchor_b ? "/anchor_b" : "/anchor",
               (spec_.name.empty() ? "the joint's" : "joint \"" + spec_.name + "\": its") +
                   " anchor is too far from the centre of mass of its " +
                   (body == joint.a ? "first" : "second") + " body: " + numbers +
                   " the body's radius of gyration, where at most 1e5 times is allowed; put it "
                   "nearer, or give the body a greater inertia");
    }

    void set_length(Joint& joint) const {
        if (spec_.kind != JointKind::distance) return;
        joint.length = (spec_.anchor - spec_.anchor_b.value_or(spec_.anchor)).norm();
        if (joint.locked[kAlongX] && !(joint.length > 1e-9))
            refuse("/anchor_b", "a distance joint needs two anchors that are apart");
    }

    /// Three rotations: each axis of a against the next of b. Two: the free axis of a against the
    /// other two of b. One: the two that the locked axis is square to.
    void set_turns(Joint& joint) const {
        const Matrix3d on_a = joint.frame_a.rotation.toRotationMatrix(),
                       on_b = joint.frame_b.rotation.toRotationMatrix();
        int locked = 0, free = -1;
        for (int k = 0; k < 3; ++k) {
            if (joint.locked[kTurnX + k])
                ++locked;
            else
                free = k;
        }
        for (int k = 0; k < 3; ++k) {
            if (!joint.locked[kTurnX + k]) continue;
            const int next = (k + 1) % 3, last = (k + 2) % 3;
            if (locked == 2)
                joint.turns[k] = {on_a.col(free), on_b.col(3 - k - free)};
            else if (locked == 3)
                joint.turns[k] = {on_a.col(next), on_b.col(last)};
            else
                joint.turns[k] = {on_a.col(last), on_b.col(next)};
        }
    }

    void add_drives(JointDraft& draft) const {
        for (std::uint32_t axis = 0; axis < kJointAxes; ++axis) {
            JointAxisSpec spec = spec_.axes[axis];
            // A size that cannot be less than 0 needs nothing that holds it there.
            if (is_never_negative(spec_.kind, axis) && spec.lower == 0)
                spec.lower = -std::numeric_limits<double>::infinity();
            const auto add = [&](DriveKind kind) {
                draft.drives.push_back({0, axis, kind, spec, 0});
            };
            if (spec.motor.mode != MotorMode::none) add(DriveKind::motor);
            if (spec.stiffness > 0 || spec.damping > 0) add(DriveKind::spring);
            if (spec.friction > 0) add(DriveKind::friction);
            if (std::isfinite(spec.greatest_speed)) add(DriveKind::speed);
            // what comes last has the last word
            if (std::isfinite(spec.lower) || std::isfinite(spec.upper)) add(DriveKind::limit);
        }
    }

    const World& world_;
    const JointSpec& spec_;
    const std::string& pointer_;
};

}  // namespace

JointDraft make_joint(const World& world, const JointSpec& spec, const std::string& pointer) {
    return Builder(world, spec, pointer).make();
}

void append_joint(World& world, JointDraft draft) {
    JointTable& table = world.joints;
    const auto index = static_cast<std::uint32_t>(table.size());
    draft.joint.id = table.next_id++;
    table.joints.push_back(draft.joint);
    table.turn.push_back(0);
    for (JointDrive& drive : draft.drives) {
        drive.joint = index;
        table.drives.push_back(drive);
    }
    if (draft.joint.keeps_apart) world.excluded.push_back(kept_apart(draft.joint));
}

JointCoupling make_coupling(const World& world, const CouplingSpec& spec,
                            const std::string& pointer) {
    if (const std::optional<JointFault> fault = find_fault(spec))
        throw SceneError("", pointer + "/" + fault->key, fault->sentence);
    const JointTable& table = world.joints;
    for (const auto& [joint, axis] :
         {std::pair{spec.joint_a, spec.axis_a}, {spec.joint_b, spec.axis_b}}) {
        if (joint >= table.size() || axis >= kJointAxes)
            throw SceneError("", pointer + "/joints", "a coupling ties two joints of the scene");
        const Joint& tied = table.joints[joint];
        if (tied.locked[axis] || !has_coordinate(tied.kind, axis))
            throw SceneError("", pointer + "/joints",
                             "a coupling ties axes that the joints leave free");
    }
    const double offset =
        start_coordinate(world, spec.joint_b) - spec.ratio * start_coordinate(world, spec.joint_a);
    return {0,
            spec.joint_a,
            spec.joint_b,
            spec.axis_a,
            spec.axis_b,
            spec.ratio,
            spec.offset.value_or(offset),
            0,
            offset - spec.offset.value_or(offset)};
}

void append_coupling(World& world, JointCoupling coupling) {
    coupling.id = world.joints.next_coupling_id++;
    world.joints.couplings.push_back(coupling);
}

void count_springs(World& world) {
    JointTable& table = world.joints;
    std::vector<std::uint32_t> of_body(world.bodies.size(), 0);
    const auto spring = [](const Joint& joint, std::uint32_t k) {
        return joint.locked[k] && joint.compliance_of(k) > 0;
    };
    // along its axes, which are at right angles, a joint is one spring, and about them another
    std::vector<std::array<bool, 2>> springs(table.size());
    for (std::uint32_t i = 0; i < table.size(); ++i)
        for (std::uint32_t k = 0; k < kJointAxes; ++k)
            if (spring(table.joints[i], k)) springs[i][k >= kTurnX] = true;
    for (const JointDrive& drive : table.drives)
        if (drive.is_spring()) springs[drive.joint][drive.axis >= kTurnX] = true;
    const auto counts = [&](std::uint32_t body) {
        return body != kNoIndex && is_movable(world.bodies.motion[body]);
    };
    for (std::uint32_t i = 0; i < table.size(); ++i)
        for (const std::uint32_t body : {table.joints[i].a, table.joints[i].b})
            if (counts(body)) of_body[body] += std::uint32_t(springs[i][0]) + springs[i][1];
    for (Joint& joint : table.joints) {
        joint.crowd = 0;
        for (const std::uint32_t body : {joint.a, joint.b})
            if (counts(body)) joint.crowd = std::max(joint.crowd, of_body[body]);
    }
}

void build_joints(World& world, const Scene& scene) {
    for (std::size_t i = 0; i < scene.joints.size(); ++i)
        append_joint(world, make_joint(world, scene.joints[i], "/joints/" + std::to_string(i)));
    for (std::size_t i = 0; i < scene.couplings.size(); ++i)
        append_coupling(
            world, make_coupling(world, scene.couplings[i], "/couplings/" + std::to_string(i)));
    std::sort(world.excluded.begin(), world.excluded.end());
    count_springs(world);
}

}  // namespace plumb
