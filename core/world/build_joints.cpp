// SPDX-License-Identifier: MIT
#include "world/build_joints.h"

#include "scene/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace plumb {
namespace {

using Axes = std::array<bool, kJointAxes>;

/// The rows that each kind takes away, in the order of JointKind.
constexpr Axes kLocked[] = {
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

class Builder {
public:
    Builder(const World& world, const JointSpec& spec, const std::string& pointer)
        : world_(world), spec_(spec), pointer_(pointer) {}

    JointDraft make() {
        check_bodies();
        check_numbers();
        JointDraft draft;
        Joint& joint = draft.joint;
        joint.kind = spec_.kind;
        joint.a = spec_.body_a, joint.b = spec_.body_b;
        joint.locked = spec_.kind == JointKind::six_axis
                           ? spec_.locked
                           : kLocked[static_cast<std::size_t>(spec_.kind)];
        joint.frame_a = in_body(joint.a, spec_.anchor);
        joint.frame_b = in_body(joint.b, spec_.anchor_b.value_or(spec_.anchor));
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
        auto dynamic = [&](std::uint32_t k) {
            return k != kNoIndex && b.motion[k] == Motion::dynamic;
        };
        if (!dynamic(spec_.body_a) && !dynamic(spec_.body_b))
            refuse("/bodies", "at least one of the linked bodies must be dynamic");
    }

    void check_numbers() const {
        if (!spec_.anchor.allFinite() || (spec_.anchor_b && !spec_.anchor_b->allFinite()))
            refuse("/anchor", "must be finite numbers");
        if (!spec_.frame.coeffs().allFinite() || std::abs(spec_.frame.norm() - 1) > 1e-6)
            refuse("/axis", "the joint's frame must be a unit quaternion");
        if (!(spec_.compliance >= 0) || !(spec_.angular_compliance >= 0) ||
            !std::isfinite(spec_.compliance + spec_.angular_compliance))
            refuse("/compliance", "must be 0 or above");
        if (!(spec_.breaking_force > 0)) refuse("/breaking_force", "must be above 0");
        if (!(spec_.breaking_torque > 0)) refuse("/breaking_torque", "must be above 0");
    }

    Placement in_body(std::uint32_t body, const Vector3d& anchor) const {
        if (body == kNoIndex) return {anchor, spec_.frame};
        const Quaterniond back = world_.bodies.orientation[body].conjugate();
        return {back * (anchor - world_.bodies.position[body]), (back * spec_.frame).normalized()};
    }

    /// A distance that has limits is held by them, as a rope is.
    void set_length(Joint& joint) const {
        if (spec_.kind != JointKind::distance) return;
        joint.length = (spec_.anchor - spec_.anchor_b.value_or(spec_.anchor)).norm();
        const JointAxisSpec& axis = spec_.axes[kAlongX];
        if (std::isfinite(axis.lower) || std::isfinite(axis.upper) || axis.stiffness > 0)
            joint.locked[kAlongX] = false;
        else if (!(joint.length > 1e-9))
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
            const JointAxisSpec& spec = spec_.axes[axis];
            auto add = [&](DriveKind kind) {
                if (draft.joint.locked[axis])
                    refuse("",
                           "this kind of joint is locked along an axis that has a limit, a "
                           "motor, a spring, friction or a greatest speed");
                check_axis(spec);
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

    void check_axis(const JointAxisSpec& axis) const {
        if (!(axis.lower <= axis.upper))
            refuse("/limits", "the lower limit must not be above the upper one");
        if (!(axis.greatest_speed >= 0)) refuse("/max_speed", "must be 0 or above");
        if (!(axis.motor.greatest >= 0)) refuse("/motor/max", "must be 0 or above");
        if (!(axis.motor.frequency > 0) || !(axis.motor.damping_ratio >= 0))
            refuse("/motor", "the frequency must be above 0 and the damping ratio 0 or above");
        if (!std::isfinite(axis.motor.target + axis.rest + axis.stiffness + axis.damping) ||
            axis.stiffness < 0 || axis.damping < 0 || !(axis.friction >= 0))
            refuse("", "springs, dampers and friction must be finite and 0 or above");
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
    const JointTable& table = world.joints;
    for (const auto& [joint, axis] :
         {std::pair{spec.joint_a, spec.axis_a}, {spec.joint_b, spec.axis_b}}) {
        if (joint >= table.size() || axis >= kJointAxes)
            throw SceneError("", pointer + "/joints", "a coupling ties two joints of the scene");
        if (table.joints[joint].locked[axis])
            throw SceneError("", pointer + "/joints",
                             "a coupling ties axes that the joints leave free");
    }
    if (!std::isfinite(spec.ratio) || spec.ratio == 0)
        throw SceneError("", pointer + "/ratio", "must be a finite number other than 0");
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
            0};
}

void append_coupling(World& world, JointCoupling coupling) {
    coupling.id = world.joints.next_coupling_id++;
    world.joints.couplings.push_back(coupling);
}

void build_joints(World& world, const Scene& scene) {
    for (std::size_t i = 0; i < scene.joints.size(); ++i)
        append_joint(world, make_joint(world, scene.joints[i], "/joints/" + std::to_string(i)));
    for (std::size_t i = 0; i < scene.couplings.size(); ++i)
        append_coupling(
            world, make_coupling(world, scene.couplings[i], "/couplings/" + std::to_string(i)));
    std::sort(world.excluded.begin(), world.excluded.end());
}

}  // namespace plumb
