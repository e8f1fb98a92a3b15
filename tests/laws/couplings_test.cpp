// SPDX-License-Identifier: MIT
/// Gears, racks and what else ties two joints' coordinates, against formulas. 1/60 s × 20 substeps
/// × 1 iteration unless a test says otherwise.
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

class Couplings : public InEachPrecision {
protected:
    /// Without gravity, on joints of the same kind to the world: body 0, a cube of 1 m and 1000 kg
    /// at the origin, and body 1, a cube of 0.8 m and 512 kg at x = 300.
    Scene scene(JointKind kind) const {
        Scene s;
        use_fine_steps(s.settings);
        s.settings.precision = GetParam();
        s.settings.gravity.setZero();
        add_body(s, box(0.5, 0.5, 0.5), Vector::Zero());
        add_body(s, box(0.4, 0.4, 0.4), {300, 0, 0});
        JointSpec joint;
        joint.kind = kind;
        for (const std::uint32_t i : {0u, 1u}) {
            joint.body_a = i, joint.anchor = s.bodies[i].placement.position;
            s.joints.push_back(joint);
        }
        return s;
    }
    static constexpr double kInertia = 1000.0 / 6, kInertiaB = 512 * 0.64 / 6;
};
INSTANTIATE_TEST_SUITE_P(, Couplings, each_precision(), precision_name);

/// Two hinged wheels tied by q_b = r q_a, the torque τ on the first: α_a = τ / (I_a + r² I_b).
TEST_P(Couplings, AGearSharesTorqueByItsRatio) {
    for (const double ratio : {-2.0, 0.5, 3.0}) {
        Scene s = scene(JointKind::hinge);
        CouplingSpec gear;
        gear.joint_a = 0, gear.joint_b = 1, gear.ratio = ratio;
        s.couplings.push_back(gear);
        s.bodies[0].torque = {100, 0, 0};
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 2);
        const double alpha = 100 / (kInertia + ratio * ratio * kInertiaB);
        EXPECT_NEAR(simulation.joint_motion(0, kTurnX).velocity, 2 * alpha, 0.005 * 2 * alpha);
        EXPECT_NEAR(joint_position(simulation, 1, kTurnX),
                    ratio * joint_position(simulation, 0, kTurnX), 1e-5);
    }
}

TEST_P(Couplings, ARackFollowsItsPinion) {
    Scene s = scene(JointKind::hinge);
    s.joints[1].kind = JointKind::slider;
    CouplingSpec rack;
    rack.joint_a = 0, rack.joint_b = 1, rack.axis_b = kAlongX, rack.ratio = 0.25;  // [m/rad]
    s.couplings.push_back(rack);
    s.bodies[0].torque = {100, 0, 0};
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 2);
    const double alpha = 100 / (kInertia + 0.25 * 0.25 * 512);
    EXPECT_NEAR(simulation.joint_motion(0, kTurnX).velocity, 2 * alpha, 0.005 * 2 * alpha);
    EXPECT_NEAR(joint_position(simulation, 1, kAlongX),
                0.25 * joint_position(simulation, 0, kTurnX), 1e-5);
}

/// Two wheels or sliders tied with an offset far from where they stand come together at the speed
/// of recovery, each by its share: q̇_b = s (1/I_b) / (1/I_b + r²/I_a). Then they are at rest.
TEST_P(Couplings, ACouplingComesToAFarOffsetAtTheSpeedOfRecovery) {
    for (const JointKind kind : {JointKind::hinge, JointKind::slider}) {
        const std::uint32_t axis = kind == JointKind::hinge ? kTurnX : kAlongX;
        for (const auto& [ratio, offset] : {std::pair{1.0, 10.0}, {-2.0, -30.0}}) {
            Scene s = scene(kind);
            s.settings.recovery_speed = 5;
            CouplingSpec tie;
            tie.joint_a = 0, tie.joint_b = 1, tie.axis_a = tie.axis_b = axis;
            tie.ratio = ratio, tie.offset = offset;
            s.couplings.push_back(tie);
            Simulation simulation(s, colliders(), "reference");
            const double of_a = kind == JointKind::hinge ? 1 / kInertia : 1.0 / 1000;
            const double of_b = kind == JointKind::hinge ? 1 / kInertiaB : 1.0 / 512;
            const double speed = std::copysign(5.0, offset) * of_b / (of_b + ratio * ratio * of_a);
            const double end = std::abs(offset) / 5;
            double fastest = 0;
            run_for(simulation, end / 2);
            EXPECT_NEAR(joint_position(simulation, 1, axis), speed * end / 2,
                        2e-3 * std::abs(offset));
            for (int i = 0; i < 60 * (end / 2 + 0.5); ++i) {
                ASSERT_TRUE(simulation.step().finite);
                const double now = simulation.joint_motion(1, axis).velocity;
                fastest = std::max(fastest, std::abs(now));
            }
            EXPECT_LT(fastest, std::abs(speed) * 1.01);
            EXPECT_NEAR(joint_position(simulation, 1, axis),
                        ratio * joint_position(simulation, 0, axis) + offset, 1e-4);
            EXPECT_NEAR(joint_position(simulation, 1, axis), speed * end, 2e-3 * std::abs(offset));
            EXPECT_NEAR(simulation.joint_motion(1, axis).velocity, 0, 1e-3);
        }
    }
}

/// What the motion adds to a coupling's error goes at once: two arms that a gear ties, in long
/// steps of few iterations.
TEST_P(Couplings, ACouplingHoldsUnderLoadInLongSteps) {
    Scene s = scene(JointKind::hinge);
    s.settings.dt = 0.01, s.settings.substeps = 1, s.settings.position_iterations = 5;
    s.settings.gravity = {0, -kGravity, 0};
    for (JointSpec& joint : s.joints) joint.anchor.z() = 1;
    CouplingSpec gear;
    gear.joint_a = 0, gear.joint_b = 1, gear.ratio = -30;
    s.couplings.push_back(gear);
    Simulation simulation(s, colliders(), "reference");
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(simulation.step().finite);
        worst = std::max(worst, std::abs(gear.ratio * joint_position(simulation, 0, kTurnX) -
                                         joint_position(simulation, 1, kTurnX)));
    }
    EXPECT_GT(std::abs(joint_position(simulation, 1, kTurnX)), 2);
    EXPECT_LT(worst, 0.05);
}

TEST_P(Couplings, ACouplingThatLimitsHoldBackStaysCalm) {
    Scene s = scene(JointKind::hinge);
    s.joints[0].axes[kTurnX].lower = s.joints[0].axes[kTurnX].upper = 0;
    s.joints[1].axes[kTurnX].lower = -1, s.joints[1].axes[kTurnX].upper = 1;
    CouplingSpec far;
    far.joint_a = 0, far.joint_b = 1, far.offset = 10;
    s.couplings.push_back(far);
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1.2);
    for (int i = 0; i < 600; ++i) {
        ASSERT_TRUE(simulation.step().finite);
        ASSERT_NEAR(joint_position(simulation, 1, kTurnX), 1, 1e-3);
        ASSERT_NEAR(joint_position(simulation, 0, kTurnX), 0, 1e-3);
    }
}

/// An arm of six links of 0.2 m, fixed to the world at one end, with two fingers at the other, of
/// which one follows the other within limits. It is a tree but for that coupling.
Scene arm_with_gripper(Precision precision, bool held) {
    Scene s;
    s.settings.precision = precision;
    const auto hold = [held](JointSpec& joint, std::uint32_t axis, double greatest) {
        if (!held) return;
        joint.axes[axis].motor.mode = MotorMode::position;
        joint.axes[axis].motor.greatest = greatest;
        joint.axes[axis].motor.frequency = 60;
        joint.axes[axis].damping = 100;
    };
    for (std::uint32_t i = 0; i < 6; ++i) {
        add_body(s, box(0.1, 0.04, 0.04), {0.1 + 0.2 * i, 0, 0}).mass = 3;
        JointSpec& hinge =
            add_joint(s, JointKind::hinge, i, i == 0 ? kNoIndex : i - 1, {0.2 * i, 0, 0});
        hinge.frame = Rotation::FromTwoVectors(Vector::UnitX(), Vector::UnitZ());
        hold(hinge, kTurnX, 300);
    }
    for (const double side : {-1.0, 1.0}) {
        add_body(s, box(0.05, 0.01, 0.01), {1.25, 0, 0.03 * side}).mass = 0.1;
        JointSpec& slider =
            add_joint(s, JointKind::slider, static_cast<std::uint32_t>(s.bodies.size()) - 1, 5,
                      {1.2, 0, 0.03 * side});
        slider.frame = Rotation::FromTwoVectors(Vector::UnitX(), side * Vector::UnitZ());
        slider.axes[kAlongX].lower = -0.015, slider.axes[kAlongX].upper = 0.01;
        if (side < 0) hold(slider, kAlongX, 20);
    }
    CouplingSpec mimic;
    mimic.joint_a = 6, mimic.joint_b = 7, mimic.axis_a = mimic.axis_b = kAlongX;
    s.couplings.push_back(mimic);
    return s;
}

/// Runs it at the usual step and at drawn ones: its joints stay closed, and its fingers together.
void expect_arm_holds(Scene s, double greatest_speed) {
    Random random(31);
    for (int draw = 0; draw < 8; ++draw) {
        if (draw > 0) s.settings.dt = random.number(0.002, 0.0167);
        if (draw > 0) s.settings.substeps = 1 + random.below(10);
        SCOPED_TRACE(testing::Message() << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), "reference");
        double worst = 0;
        while (simulation.time() < 3) {
            simulation.step();
            for (const double error : joint_errors(simulation.world()))
                worst = std::max(worst, error);
        }
        EXPECT_LE(worst, 1e-5);
        EXPECT_LE(fastest_point(simulation.world()), greatest_speed);
        EXPECT_NEAR(joint_position(simulation, 6, kAlongX), joint_position(simulation, 7, kAlongX),
                    1e-5);
    }
}

TEST_P(Couplings, AnArmWithAGripperIsHeldOut) {
    expect_arm_holds(arm_with_gripper(GetParam(), true), 2e-3);
}

TEST_P(Couplings, AnArmWithAGripperFallsOnTheGround) {
    Scene s = arm_with_gripper(GetParam(), false);
    add_ground(s).placement.position.y() = -0.3;
    expect_arm_holds(s, 0.05);
}

}  // namespace
}  // namespace plumb::test
