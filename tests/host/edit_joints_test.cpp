// SPDX-License-Identifier: MIT
/// Joints that come and go while a simulation runs, against formulas.
#include "host/editing.h"

namespace plumb::test {
namespace {

JointSpec ball_joint(std::uint32_t a, std::uint32_t b, const Vector& anchor) {
    JointSpec joint;
    joint.body_a = a, joint.body_b = b;
    joint.anchor = anchor;
    return joint;
}

/// Balls of 1 kg in a row along x, a metre apart, in the air.
Scene balls(int count) {
    Scene s;
    for (int i = 0; i < count; ++i) add_body(s, sphere(0.1), {1.0 * i, 5, 0}).mass = 1;
    return s;
}

TEST(EditedJoint, WhatItLetsGoFliesOnAParabola) {
    Scene scene = balls(1);
    scene.joints.push_back(ball_joint(0, kNoIndex, {-1, 5, 0}));
    Simulation s(scene, colliders(), "reference");
    make_steps(s, 40);
    s.remove_joint(0);
    const BodyState start = s.body_state(0);
    EXPECT_GT(start.velocity.norm(), 2);
    make_steps(s, 50);
    const double t = 50 * kStep;
    const Vector expected = start.placement.position + t * start.velocity -
                            Vector(0, kGravity * t * (t + kStep) / 2, 0);
    EXPECT_LT((s.body_state(0).placement.position - expected).norm(), 1e-12);
}

TEST(EditedJoint, HoldsWhatFallsFromWhereItIs) {
    Simulation s(balls(1), colliders(), "reference");
    make_steps(s, 30);
    const Vector hook = s.body_state(0).placement.position + Vector(0, 0.5, 0);
    const std::uint32_t joint = s.add_joint(ball_joint(0, kNoIndex, hook));
    s.set_velocity(0, Vector::Zero(), Vector::Zero());
    make_steps(s, 100);
    EXPECT_LT((s.body_state(0).placement.position - hook).norm() - 0.5, 1e-7);
    EXPECT_NEAR(s.joint_load(joint).force.y(), kGravity, 1e-3) << "it bears 1 kg";
    EXPECT_NEAR(s.joint_load(joint).force.x(), 0, 1e-9);
}

TEST(EditedJoint, ComingAndGoingKeepMomentum) {
    for (const JointMethod method : {JointMethod::tree, JointMethod::iterate}) {
        Scene scene = balls(6);
        scene.settings.gravity.setZero();
        scene.settings.joints = method;
        scene.settings.precision = Precision::double_;
        use_fine_steps(scene.settings);
        for (std::size_t i = 0; i < 6; ++i) {
            scene.bodies[i].velocity = {0, 1.0 * static_cast<double>(i % 3), 0.5};
            scene.bodies[i].mask = 0;
        }
        Simulation s(scene, colliders(), "reference");
        const Vector linear = linear_momentum(s.world()), angular = angular_momentum(s.world());
        for (std::uint32_t i = 0; i + 1 < 6; ++i) {
            make_steps(s, 5);
            const Vector middle =
                (s.body_state(i).placement.position + s.body_state(i + 1).placement.position) / 2;
            s.add_joint(ball_joint(i, i + 1, middle));
        }
        make_steps(s, 20);
        s.remove_joint(2);
        make_steps(s, 20);
        EXPECT_LT((linear_momentum(s.world()) - linear).norm(), 1e-12 * linear.norm());
        EXPECT_LT((angular_momentum(s.world()) - angular).norm(), 1e-10 * angular.norm());
        double parted = 0;
        for (const double error : joint_errors(s.world())) parted = std::max(parted, error);
        EXPECT_LT(parted, method == JointMethod::tree ? 1e-8 : 1e-2);
    }
}

/// Where a wheel with a motor stands, how fast it turns and what its bearing bears, before and
/// after other joints went.
TEST(EditedJoint, OthersKeepTheirNamesCountsAndTargets) {
    Scene scene = balls(3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        JointSpec hinge = ball_joint(i, kNoIndex, {1.0 * i, 5, 0});
        hinge.kind = JointKind::hinge;
        hinge.axes[kTurnX].motor.mode = MotorMode::velocity;
        hinge.axes[kTurnX].motor.target = 10;
        scene.joints.push_back(hinge);
    }
    Simulation s(scene, colliders(), "reference");
    make_steps(s, 200);
    const Simulation::JointMotion before = s.joint_motion(2, kTurnX);
    EXPECT_NEAR(before.velocity, 10, 1e-4);
    EXPECT_NEAR(before.position, 20, 0.2) << "three turns and more";
    s.remove_joint(0);
    s.remove_body(1);
    EXPECT_EQ(s.world().joints.size(), 1u);
    EXPECT_FALSE(s.has_joint(0));
    EXPECT_FALSE(s.has_joint(1)) << "it went with its body";
    EXPECT_TRUE(s.has_joint(2));
    EXPECT_EQ(s.joint_motion(2, kTurnX).position, before.position);
    EXPECT_NEAR(s.joint_load(2).force.y(), kGravity, 1e-4);
    s.set_motor_target(2, kTurnX, -4);
    s.step();
    EXPECT_NEAR(s.joint_motion(2, kTurnX).velocity, -4, 1e-4);
    const double inertia = 0.4 * 1 * 0.1 * 0.1;
    EXPECT_NEAR(s.joint_load(2).torque.x(), inertia * (-4 - 10) / kStep / 2, 1e-3)
        << "the mean of two substeps, of which one drove it";
    EXPECT_THROW(s.is_broken(1), std::out_of_range);
}

TEST(EditedJoint, ABrokenOneStaysBroken) {
    Scene scene = balls(2);
    for (std::uint32_t i = 0; i < 2; ++i) {
        scene.joints.push_back(ball_joint(i, kNoIndex, {1.0 * i, 5.5, 0}));
        scene.joints[i].breaking_force = i == 0 ? 5 : 500;
    }
    Simulation s(scene, colliders(), "reference");
    make_steps(s, 10);
    ASSERT_TRUE(s.is_broken(0));
    ASSERT_FALSE(s.is_broken(1));
    const double speed = s.body_state(0).velocity.y();
    s.add_joint(ball_joint(
        0, 1, (s.body_state(0).placement.position + s.body_state(1).placement.position) / 2));
    s.remove_joint(2);
    make_steps(s, 10);
    EXPECT_TRUE(s.is_broken(0));
    EXPECT_NEAR(s.body_state(0).velocity.y(), speed - 10 * kStep * kGravity, 1e-9)
        << "it falls freely";
}

/// Two balls that overlap, and joints between them.
TEST(EditedJoint, WhatItLinkedCollidesAgain) {
    for (const char* collider : {"reference", "ode", "bullet", "fcl"}) {
        Scene scene = balls(2);
        scene.settings.gravity.setZero();
        scene.bodies[1].placement.position.x() = 0.15;
        Simulation s(scene, colliders(), collider);
        EXPECT_EQ(s.step().contacts, 1u);
        const std::uint32_t first = s.add_joint(ball_joint(0, 1, {0, 5, 0}));
        const std::uint32_t second = s.add_joint(ball_joint(1, 0, {0.1, 5, 0}));
        EXPECT_EQ(s.step().contacts, 0u);
        s.remove_joint(first);
        EXPECT_EQ(s.step().contacts, 0u) << "the other still keeps them apart";
        s.remove_joint(second);
        EXPECT_EQ(s.step().contacts, 1u);
    }
}

TEST(EditedJoint, ACouplingTiesThemAsTheyStand) {
    Scene scene = balls(2);
    scene.settings.gravity.setZero();
    for (std::uint32_t i = 0; i < 2; ++i) {
        scene.joints.push_back(ball_joint(i, kNoIndex, {1.0 * i, 5, 0}));
        scene.joints[i].kind = JointKind::hinge;
    }
    scene.bodies[0].angular_velocity = {2, 0, 0};
    Simulation s(scene, colliders(), "reference");
    make_steps(s, 50);
    const double a = s.joint_motion(0, kTurnX).position, b = s.joint_motion(1, kTurnX).position;
    EXPECT_NEAR(a, 1, 1e-4);
    EXPECT_NEAR(b, 0, 1e-9);
    CouplingSpec spec;
    spec.joint_a = 0, spec.joint_b = 1;
    spec.ratio = -2;
    const std::uint32_t coupling = s.add_coupling(spec);
    make_steps(s, 100);
    // what the first had is shared: I ω = (1 + ratio²) I ω′
    EXPECT_NEAR(s.joint_motion(0, kTurnX).velocity, 0.4, 1e-3);
    EXPECT_NEAR(s.joint_motion(1, kTurnX).velocity, -0.8, 1e-3);
    EXPECT_NEAR(s.joint_motion(1, kTurnX).position - b,
                -2 * (s.joint_motion(0, kTurnX).position - a), 1e-4);
    s.remove_coupling(coupling);
    s.set_velocity(1, Vector::Zero(), Vector::Zero());
    make_steps(s, 10);
    EXPECT_NEAR(s.joint_motion(1, kTurnX).velocity, 0, 1e-9);
    EXPECT_NEAR(s.joint_motion(0, kTurnX).velocity, 0.4, 1e-3);
    EXPECT_THROW(s.remove_coupling(coupling), std::out_of_range);
    s.add_coupling(spec);
    s.remove_joint(0);
    EXPECT_TRUE(s.world().joints.couplings.empty()) << "it goes with its joint";
}

}  // namespace
}  // namespace plumb::test
