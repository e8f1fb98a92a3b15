// SPDX-License-Identifier: MIT
/// Joints and couplings that make no sense: each fault is found, and told where it is.
#include "scene/joint_faults.h"

#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace plumb {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

JointSpec joint_of(JointKind kind) {
    JointSpec joint;
    joint.kind = kind;
    joint.body_a = 0;
    return joint;
}

/// All kinds, each with what it can use on an axis that it leaves free, if it has one.
std::vector<JointSpec> all_joints() {
    std::vector<JointSpec> joints;
    for (std::size_t i = 0; i < std::size(kLocked); ++i) {
        JointSpec joint = joint_of(static_cast<JointKind>(i));
        if (joint.kind == JointKind::distance) {
            joint.anchor_b = Eigen::Vector3d(0, 1, 0);
            joint.axes[kAlongX].upper = 2;
        }
        for (std::uint32_t axis = 0; axis < kJointAxes; ++axis) {
            if (!is_free(joint, axis)) continue;
            JointAxisSpec& spec = joint.axes[axis];
            spec.lower = 0, spec.upper = 2, spec.stiffness = 3, spec.damping = 4, spec.friction = 5;
            spec.greatest_speed = 6;
            if (joint.kind == JointKind::cone_twist && axis == kTurnY) continue;
            spec.motor.mode = MotorMode::velocity;
            spec.motor.keys = {{0, 1}, {2, 3}};
        }
        joints.push_back(joint);
    }
    return joints;
}

/// The numbers of a joint that may be spoiled; those of its axes only where it has a motor.
std::vector<double*> numbers_of(JointSpec& j) {
    std::vector<double*> numbers{&j.anchor.x(),        &j.anchor.z(),     &j.frame.x(),
                                 &j.compliance,        &j.breaking_force, &j.breaking_torque,
                                 &j.angular_compliance};
    if (j.anchor_b) numbers.push_back(&j.anchor_b->y());
    for (JointAxisSpec& a : j.axes) {
        for (double* number : {&a.lower, &a.upper, &a.stiffness, &a.rest, &a.damping, &a.friction,
                               &a.greatest_speed})
            numbers.push_back(number);
        if (a.motor.mode == MotorMode::none) continue;
        for (double* number :
             {&a.motor.target, &a.motor.greatest, &a.motor.frequency, &a.motor.damping_ratio,
              &a.motor.keys[1].time, &a.motor.keys[1].value})
            numbers.push_back(number);
    }
    return numbers;
}

TEST(JointFaults, GoodJointsHaveNone) {
    for (const JointSpec& joint : all_joints()) {
        const auto fault = find_fault(joint);
        EXPECT_FALSE(fault) << static_cast<int>(joint.kind) << ": " << fault->sentence;
        EXPECT_FALSE(find_fault(joint_of(joint.kind)));
    }
}

TEST(JointFaults, NoNumberMayBeNone) {
    const std::size_t kinds = all_joints().size();
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        JointSpec count = all_joints()[kind];
        for (std::size_t i = 0; i < numbers_of(count).size(); ++i) {
            JointSpec joint = all_joints()[kind];
            *numbers_of(joint)[i] = kNan;
            EXPECT_TRUE(find_fault(joint)) << "number " << i << " of kind " << kind;
        }
    }
}

void expect_fault(const JointSpec& joint, std::uint32_t axis, const std::string& key) {
    const auto fault = find_fault(joint);
    ASSERT_TRUE(fault) << key;
    EXPECT_EQ(fault->axis, axis) << fault->sentence;
    EXPECT_EQ(fault->key, key) << fault->sentence;
    EXPECT_FALSE(fault->sentence.empty());
}

/// A change of a joint's one axis.
void expect_bad_axis(JointKind kind, std::uint32_t axis, const std::string& key,
                     void (*spoil)(JointAxisSpec&)) {
    JointSpec joint = joint_of(kind);
    if (kind == JointKind::distance) joint.anchor_b = Eigen::Vector3d(0, 1, 0);
    spoil(joint.axes[axis]);
    expect_fault(joint, axis, key);
}

TEST(JointFaults, AreToldWhereTheyAre) {
    using A = JointAxisSpec;
    const auto hinge = [](const std::string& key, void (*spoil)(A&)) {
        expect_bad_axis(JointKind::hinge, kTurnX, key, spoil);
    };
    hinge("limits", [](A& a) { a.lower = 1, a.upper = 0; });
    hinge("limits", [](A& a) { a.lower = kInfinite; });
    const auto never_holds = [](A& a) { a.lower = -4, a.upper = 3; };
    expect_bad_axis(JointKind::universal, kTurnY, "limits", never_holds);
    expect_bad_axis(JointKind::ball, kTurnZ, "limits", never_holds);
    expect_bad_axis(JointKind::cone_twist, kTurnX, "limits", never_holds);
    hinge("spring/stiffness", [](A& a) { a.stiffness = -1; });
    hinge("spring/damping", [](A& a) { a.damping = kInfinite; });
    hinge("friction", [](A& a) { a.friction = -1; });
    hinge("max_speed", [](A& a) { a.greatest_speed = -1; });
    hinge("motor", [](A& a) { a.motor.mode = MotorMode(7); });
    const auto driven = [](const std::string& key, void (*spoil)(A&)) {
        JointSpec joint = joint_of(JointKind::slider);
        joint.axes[kAlongX].motor.mode = MotorMode::position;
        spoil(joint.axes[kAlongX]);
        expect_fault(joint, kAlongX, key);
    };
    driven("motor/position", [](A& a) { a.motor.target = kInfinite; });
    driven("motor/max", [](A& a) { a.motor.greatest = -1; });
    driven("motor/frequency", [](A& a) { a.motor.frequency = 0; });
    driven("motor/damping_ratio", [](A& a) { a.motor.damping_ratio = -1; });
    driven("motor/position/1/0", [](A& a) { a.motor.keys = {{1, 0}, {1, 1}}; });
    driven("motor/position/0/0", [](A& a) { a.motor.keys = {{-1, 0}}; });
    driven("motor/position/0/1", [](A& a) { a.motor.keys = {{1, kNan}}; });
}

TEST(JointFaults, OfAxesThatAKindHasNot) {
    const auto with_friction = [](JointAxisSpec& a) { a.friction = 1; };
    expect_bad_axis(JointKind::hinge, kAlongX, "", with_friction);
    expect_bad_axis(JointKind::fixed, kTurnZ, "", with_friction);
    expect_bad_axis(JointKind::distance, kAlongX, "", with_friction);
    expect_bad_axis(JointKind::distance, kTurnX, "", with_friction);
    expect_bad_axis(JointKind::cone_twist, kTurnZ, "", with_friction);
    JointSpec six = joint_of(JointKind::six_axis);
    six.axes[kAlongY].friction = 1;
    EXPECT_FALSE(find_fault(six));
    six.locked[kAlongY] = true;
    expect_fault(six, kAlongY, "");
}

/// What has a size and no direction is never negative.
TEST(JointFaults, OfSizes) {
    const auto bounded = [](JointKind kind, std::uint32_t axis, double lower, double upper) {
        JointSpec joint = joint_of(kind);
        joint.axes[axis].lower = lower, joint.axes[axis].upper = upper;
        return find_fault(joint).has_value();
    };
    for (const auto& [lower, upper, bad] : {std::tuple{0.0, 1.0, false},
                                            {-kInfinite, 1.0, false},
                                            {0.0, 3.1416, false},
                                            {-1.0, 1.0, true},
                                            {-2.0, -1.0, true},
                                            {0.1, 1.0, true},
                                            {0.0, 3.2, true},
                                            {0.0, kInfinite, true},
                                            {-1e-3, 1.0, true}})
        EXPECT_EQ(bounded(JointKind::cone_twist, kTurnY, lower, upper), bad) << lower << upper;
    for (const auto& [lower, upper, bad] : {std::tuple{0.0, 1.0, false},
                                            {0.5, 7.0, false},
                                            {-kInfinite, 1.0, false},
                                            {0.5, kInfinite, false},
                                            {-1.0, 1.0, true},
                                            {-1.0, kInfinite, true},
                                            {-kInfinite, -1.0, true}})
        EXPECT_EQ(bounded(JointKind::distance, kAlongX, lower, upper), bad) << lower << upper;
    expect_bad_axis(JointKind::cone_twist, kTurnY, "motor",
                    [](JointAxisSpec& a) { a.motor.mode = MotorMode::velocity; });
}

TEST(JointFaults, OfJointsAsAWhole) {
    const auto bad = [](const std::string& key, void (*spoil)(JointSpec&)) {
        JointSpec joint = joint_of(JointKind::ball);
        spoil(joint);
        expect_fault(joint, kJointAxes, key);
    };
    bad("type", [](JointSpec& j) { j.kind = JointKind(99); });
    bad("anchor", [](JointSpec& j) { j.anchor.y() = 1e10; });
    bad("anchor_b", [](JointSpec& j) { j.anchor_b = j.anchor; });
    bad("axis", [](JointSpec& j) { j.frame.coeffs().setZero(); });
    bad("compliance", [](JointSpec& j) { j.compliance = -1; });
    bad("angular_compliance", [](JointSpec& j) { j.angular_compliance = kInfinite; });
    bad("breaking_force", [](JointSpec& j) { j.breaking_force = 0; });
    bad("breaking_torque", [](JointSpec& j) { j.breaking_torque = -1; });
}

TEST(JointFaults, OfCouplings) {
    const auto fault = [](void (*spoil)(CouplingSpec&)) {
        CouplingSpec coupling;
        coupling.joint_a = 0, coupling.joint_b = 1;
        spoil(coupling);
        const auto found = find_fault(coupling);
        return found ? found->key : "none";
    };
    EXPECT_EQ(fault([](CouplingSpec&) {}), "none");
    EXPECT_EQ(fault([](CouplingSpec& c) { c.offset = -100; }), "none");
    EXPECT_EQ(fault([](CouplingSpec& c) { c.joint_b = 0; }), "joints");
    EXPECT_EQ(fault([](CouplingSpec& c) { c.joint_b = 0, c.axis_b = kAlongX; }), "none");
    EXPECT_EQ(fault([](CouplingSpec& c) { c.ratio = 0; }), "ratio");
    EXPECT_EQ(fault([](CouplingSpec& c) { c.ratio = kNan; }), "ratio");
    EXPECT_EQ(fault([](CouplingSpec& c) { c.offset = kNan; }), "offset");
}

}  // namespace
}  // namespace plumb
