// SPDX-License-Identifier: MIT
/// What acts along or about a joint's free axis, against formulas. 1/60 s × 20 substeps × 1
/// iteration unless a test says otherwise.
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace plumb::test {
namespace {

using DriveCase = std::tuple<JointMethod, Precision>;

class Drives : public testing::TestWithParam<DriveCase> {
protected:
    /// Without gravity; body 0 is a cube of 1 m and 1000 kg at the origin, on joint 0 to the world.
    Scene scene(JointKind kind) const {
        Scene s;
        use_fine_steps(s.settings);
        std::tie(s.settings.joints, s.settings.precision) = GetParam();
        s.settings.gravity.setZero();
        add_body(s, box(0.5, 0.5, 0.5), Vector::Zero());
        JointSpec joint;
        joint.kind = kind;
        joint.body_a = 0;
        s.joints.push_back(joint);
        return s;
    }
    static constexpr double kInertia = 1000.0 / 6;
};
std::string drive_case_name(const testing::TestParamInfo<DriveCase>& which) {
    const auto [joints, precision] = which.param;
    return std::string(joints == JointMethod::tree ? "tree" : "iterated") + "_" +
           word_of(precision);
}
INSTANTIATE_TEST_SUITE_P(, Drives,
                         testing::Combine(testing::Values(JointMethod::tree, JointMethod::iterate),
                                          each_precision()),
                         drive_case_name);

TEST_P(Drives, AVelocityMotorSpeedsUpByItsGreatestTorqueAndHolds) {
    Scene s = scene(JointKind::hinge);
    JointMotor& motor = s.joints[0].axes[kTurnX].motor;
    motor.mode = MotorMode::velocity, motor.target = 3, motor.greatest = kInertia;  // 1 rad/s²
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 2);
    EXPECT_NEAR(simulation.joint_motion(0, kTurnX).velocity, 2, 1e-3);
    EXPECT_NEAR(joint_position(simulation, 0, kTurnX), 2, 0.005 * 2);
    EXPECT_NEAR(simulation.joint_load(0).torque.x(), kInertia, 1e-3 * kInertia);
    run_for(simulation, 2);
    EXPECT_NEAR(simulation.joint_motion(0, kTurnX).velocity, 3, 1e-5);
    EXPECT_LT(std::abs(simulation.joint_load(0).torque.x()), 1e-2);
    run_for(simulation, 10);
    EXPECT_NEAR(joint_position(simulation, 0, kTurnX), 4.5 + 3 * 11, 0.05)
        << "counted through turns";
}

/// Forces that are at their bounds are exact with a leapfrog start, as all constant forces are.
TEST_P(Drives, BoundsHoldForHalfAPush) {
    for (const MotorMode mode : {MotorMode::velocity, MotorMode::position}) {
        Scene s = scene(JointKind::slider);
        s.settings.leapfrog_start = true;
        s.settings.substeps = 1;
        JointMotor& motor = s.joints[0].axes[kAlongX].motor;
        motor.mode = mode, motor.target = 1000, motor.greatest = 1000;  // 1 m/s²
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 1);
        EXPECT_NEAR(joint_position(simulation, 0, kAlongX), 0.5, 1e-5);
    }
    Scene s = scene(JointKind::slider);
    s.settings.leapfrog_start = true;
    s.settings.substeps = 1;
    s.bodies[0].velocity = {2, 0, 0};
    s.joints[0].axes[kAlongX].friction = 1000;
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    EXPECT_NEAR(joint_position(simulation, 0, kAlongX), 1.5, 1e-5);
}

TEST_P(Drives, APositionMotorReachesItsTargetAndKeepsWithinItsTorque) {
    for (const double damping : {1.0, 0.5}) {
        Scene s = scene(JointKind::hinge);
        JointMotor& motor = s.joints[0].axes[kTurnX].motor;
        motor.mode = MotorMode::position, motor.target = 0.8, motor.frequency = 2;
        motor.damping_ratio = damping, motor.greatest = 60 * kInertia;
        Simulation simulation(s, colliders(), "reference");
        double furthest = 0, strongest = 0;
        for (int i = 0; i < 180; ++i) {
            simulation.step();
            furthest = std::max(furthest, joint_position(simulation, 0, kTurnX));
            strongest = std::max(strongest, simulation.joint_load(0).torque.norm());
        }
        const double overshoot =
            damping < 1 ? std::exp(-std::numbers::pi * damping / std::sqrt(1 - damping * damping))
                        : 0;
        EXPECT_LE(furthest, 0.8 * (1 + overshoot) + 1e-3) << damping;
        EXPECT_NEAR(joint_position(simulation, 0, kTurnX), 0.8, 1e-4) << damping;
        EXPECT_LE(strongest, motor.greatest * (1 + 1e-6)) << damping;
    }
}

/// About a hinge that is far from the centre of mass, too: the motor carries I + m r².
TEST_P(Drives, AnUndampedPositionMotorSwingsAtItsFrequency) {
    Scene s = scene(JointKind::hinge);
    s.settings.substeps = 20;
    s.joints[0].anchor = {0, 2, 0};
    JointMotor& motor = s.joints[0].axes[kTurnX].motor;
    motor.mode = MotorMode::position, motor.target = 0.2;
    motor.frequency = 1, motor.damping_ratio = 0;
    Simulation simulation(s, colliders(), "reference");
    for (int i = 0; i < 120; ++i) {
        simulation.step();
        const double law = 0.2 * (1 - std::cos(2 * std::numbers::pi * simulation.time()));
        EXPECT_NEAR(joint_position(simulation, 0, kTurnX), law, 0.02 * 0.4) << simulation.time();
    }
}

TEST_P(Drives, ALimitHoldsAgainstAMotorOfAnyForce) {
    for (const double greatest : {1e3, 1e6, std::numeric_limits<double>::infinity()}) {
        Scene s = scene(JointKind::hinge);
        s.joints[0].anchor = {0, 2, 0};
        JointAxisSpec& axis = s.joints[0].axes[kTurnX];
        axis.lower = -0.5, axis.upper = 0.5;
        axis.motor.mode = MotorMode::velocity, axis.motor.target = 5;
        axis.motor.greatest = greatest;
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 2);
        EXPECT_LT(joint_position(simulation, 0, kTurnX), 0.5 + 1e-3) << greatest;
    }
}

TEST_P(Drives, AMotorFollowsItsKeys) {
    Scene s = scene(JointKind::slider);
    JointMotor& motor = s.joints[0].axes[kAlongX].motor;
    motor.mode = MotorMode::position, motor.frequency = 10;
    motor.keys = {{0.5, 0}, {1.5, 0.4}, {2, 0.4}};
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    EXPECT_NEAR(joint_position(simulation, 0, kAlongX), 0.2, 2e-3);
    EXPECT_NEAR(simulation.joint_motion(0, kAlongX).velocity, 0.4, 1e-3);
    run_for(simulation, 1.5);
    EXPECT_NEAR(joint_position(simulation, 0, kAlongX), 0.4, 1e-5);
    simulation.set_motor_target(0, kAlongX, -0.1);
    run_for(simulation, 1.5);
    EXPECT_NEAR(joint_position(simulation, 0, kAlongX), -0.1, 1e-4);
}

TEST_P(Drives, ALimitHoldsUnderAHundredTimesTheWeight) {
    constexpr double torque = 100 * 1000 * kGravity * 0.5;  // the weight at half an edge, × 100
    for (const double side : {1.0, -1.0}) {
        Scene s = scene(JointKind::hinge);
        s.joints[0].axes[kTurnX].lower = -0.4, s.joints[0].axes[kTurnX].upper = 0.4;
        s.bodies[0].torque = {side * torque, 0, 0};
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 3);
        EXPECT_NEAR(joint_position(simulation, 0, kTurnX), side * 0.4, 1e-5);
        EXPECT_NEAR(simulation.joint_load(0).torque.x(), -side * torque, 1e-3 * torque);
    }
    Scene s = scene(JointKind::slider);
    s.joints[0].axes[kAlongX].lower = s.joints[0].axes[kAlongX].upper = 0;
    s.bodies[0].force = {100 * 1000 * kGravity, 0, 0};
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    EXPECT_NEAR(joint_position(simulation, 0, kAlongX), 0, 1e-4);
}

TEST_P(Drives, AConeHoldsItsBoneAndATwistItsTurn) {
    Scene s = scene(JointKind::cone_twist);
    s.joints[0].axes[kTurnY].upper = 0.5;
    s.joints[0].axes[kTurnX].lower = -0.2, s.joints[0].axes[kTurnX].upper = 0.2;
    s.bodies[0].torque = {300, 400, 500};
    Simulation simulation(s, colliders(), "reference");
    double swing = 0, twist = 0;
    for (int i = 0; i < 300; ++i) {
        simulation.step();
        swing = std::max(swing, joint_position(simulation, 0, kTurnY));
        twist = std::max(twist, std::abs(joint_position(simulation, 0, kTurnX)));
    }
    EXPECT_LT(swing, 0.5 + 2e-3);
    EXPECT_GT(swing, 0.5 - 2e-3);
    EXPECT_LT(twist, 0.2 + 2e-3);
}

TEST_P(Drives, ASpringSwingsAtItsFrequency) {
    Scene s = scene(JointKind::slider);
    constexpr double k = 1000 * 4 * std::numbers::pi * std::numbers::pi;  // 1 Hz
    s.joints[0].axes[kAlongX].stiffness = k, s.joints[0].axes[kAlongX].rest = 0.1;
    Simulation simulation(s, colliders(), "reference");
    double last = -1, first_crossing = 0, crossing = 0;
    int crossings = 0;
    for (int i = 0; i < 600; ++i) {
        simulation.step();
        const double x = joint_position(simulation, 0, kAlongX) - 0.1;
        if (last < 0 && x >= 0) {
            crossing = simulation.time() - simulation.world().settings.dt * x / (x - last);
            if (++crossings == 1) first_crossing = crossing;
        }
        last = x;
    }
    EXPECT_NEAR((crossing - first_crossing) / (crossings - 1), 1, 0.005);
}

TEST_P(Drives, ADamperSlowsByItsCoefficient) {
    Scene s = scene(JointKind::slider);
    s.bodies[0].velocity = {2, 0, 0};
    s.joints[0].axes[kAlongX].damping = 1000;  // 1/s of its mass
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    EXPECT_NEAR(simulation.joint_motion(0, kAlongX).velocity, 2 * std::exp(-1), 0.005);
}

TEST_P(Drives, FrictionHoldsBelowItsForceAndSlowsAboveIt) {
    Scene s = scene(JointKind::slider);
    s.joints[0].axes[kAlongX].friction = 500;
    s.bodies[0].force = {499, 0, 0};
    Simulation held(s, colliders(), "reference");
    run_for(held, 2);
    EXPECT_NEAR(joint_position(held, 0, kAlongX), 0, 1e-6);
    s.bodies[0].force = {1500, 0, 0};
    Simulation pushed(s, colliders(), "reference");
    run_for(pushed, 2);
    EXPECT_NEAR(pushed.joint_motion(0, kAlongX).velocity, 2, 1e-3);
}

/// Whatever drives it: a force to either side, or a motor that is on its way to a place.
TEST_P(Drives, AGreatestSpeedIsKept) {
    for (const double side : {1.0, -1.0}) {
        Scene s = scene(JointKind::slider);
        s.joints[0].axes[kAlongX].greatest_speed = 2;
        s.bodies[0].force = {side * 1500, 0, 0};
        Simulation pushed(s, colliders(), "reference");
        run_for(pushed, 1);
        EXPECT_NEAR(pushed.joint_motion(0, kAlongX).velocity, side * 1.5, 1e-3);
        run_for(pushed, 2);
        EXPECT_NEAR(pushed.joint_motion(0, kAlongX).velocity, side * 2, 1e-5);
        EXPECT_NEAR(pushed.joint_load(0).force.x(), -side * 1500, 1);

        s = scene(JointKind::hinge);
        JointAxisSpec& axis = s.joints[0].axes[kTurnX];
        axis.greatest_speed = 0.5;
        axis.motor.mode = MotorMode::position, axis.motor.target = side * 2;
        Simulation turned(s, colliders(), "reference");
        double fastest = 0;
        for (int i = 0; i < 600; ++i) {
            turned.step();
            fastest = std::max(fastest, std::abs(turned.joint_motion(0, kTurnX).velocity));
        }
        EXPECT_NEAR(fastest, 0.5, 1e-3);
        EXPECT_NEAR(joint_position(turned, 0, kTurnX), side * 2, 1e-4);
    }
}

/// A compliant joint stretches by α times its load in the mean of its swings, whatever the
/// iterations and substeps.
TEST_P(Drives, ComplianceIsThatOfTheSceneAtAnySettings) {
    constexpr double kStretch = 1000 * kGravity * 1e-5;
    for (const auto& [substeps, iterations] : {std::pair{1u, 5u}, {1u, 40u}, {4u, 2u}, {20u, 1u}}) {
        Scene s = scene(JointKind::ball);
        s.settings.substeps = substeps, s.settings.position_iterations = iterations;
        s.settings.gravity = {0, -kGravity, 0};
        s.joints[0].compliance = 1e-5;
        s.joints[0].axes = {};
        Simulation simulation(s, colliders(), "reference");
        double sum = 0, highest = -1;
        const int count = static_cast<int>(50 * 2 * std::numbers::pi / 10 / s.settings.dt);
        for (int i = 0; i < count; ++i) {
            simulation.step();
            const double y = simulation.world().bodies.position[0].y();
            sum += y;
            if (i > count / 2) highest = std::max(highest, y);
        }
        EXPECT_NEAR(sum / count, -kStretch, 0.005 * kStretch) << substeps << " × " << iterations;
        EXPECT_NEAR(highest, 0, 0.02 * kStretch) << "it still swings";
    }
}

TEST_P(Drives, ReactionsOfAHungBodyEqualItsWeight) {
    Scene s = scene(JointKind::fixed);
    s.settings.gravity = {0, -kGravity, 0};
    s.joints[0].anchor = {-2, 0, 0};
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    const JointLoad load = simulation.joint_load(0);
    EXPECT_LT((load.force - Vector(0, 1000 * kGravity, 0)).norm(), 0.01 * 1000 * kGravity);
    EXPECT_LT((load.torque - Vector(0, 0, 2 * 1000 * kGravity)).norm(), 0.01 * 2000 * kGravity);
}

TEST_P(Drives, AJointGivesWayAboveItsBreakingForce) {
    for (const double share : {0.9, 1.1}) {
        Scene s = scene(JointKind::ball);
        s.settings.gravity = {0, -kGravity, 0};
        s.joints[0].breaking_force = share * 1000 * kGravity;
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 1);
        EXPECT_EQ(simulation.is_broken(0), share < 1);
        EXPECT_EQ(simulation.world().bodies.position[0].y() < -4, share < 1);
    }
}

/// A rope is slack until it is as long as it may be.
TEST_P(Drives, ARopePullsAndDoesNotPush) {
    Scene s = scene(JointKind::distance);
    s.settings.gravity = {0, -kGravity, 0};
    s.joints[0].anchor = {0, 0, 0}, s.joints[0].anchor_b = Vector(0, 1, 0);
    s.joints[0].axes[kAlongX].upper = 2;
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 0.2);
    EXPECT_NEAR(simulation.world().bodies.position[0].y(), -0.5 * kGravity * 0.04, 0.01);
    run_for(simulation, 3);
    EXPECT_NEAR(simulation.world().bodies.position[0].y(), -1, 1e-4);
}

TEST_P(Drives, ARodKeepsItsLengthAsItSwings) {
    Scene s = scene(JointKind::distance);
    s.settings.gravity = {0, -kGravity, 0};
    s.joints[0].anchor = {0, 0, 0}, s.joints[0].anchor_b = Vector(1, 0, 0);
    Simulation simulation(s, colliders(), "reference");
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        simulation.step();
        worst = std::max(worst, joint_errors(simulation.world())[0]);
    }
    EXPECT_LT(worst, 1e-5);
}

TEST(JointQueries, RefuseWhatIsNotThere) {
    Scene s;
    add_body(s, box(0.5, 0.5, 0.5), {0, 0, 0});
    JointSpec joint;
    joint.kind = JointKind::hinge, joint.body_a = 0;
    s.joints.push_back(joint);
    Simulation simulation(s, colliders(), "reference");
    EXPECT_THROW(simulation.joint_motion(1, kTurnX), std::out_of_range);
    EXPECT_THROW(simulation.joint_motion(0, kAlongX), std::invalid_argument);
    EXPECT_THROW(simulation.joint_load(7), std::out_of_range);
    EXPECT_THROW(simulation.set_motor_target(0, kTurnX, 1), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::test
