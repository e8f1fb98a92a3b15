// SPDX-License-Identifier: MIT
/// What a step says of joints that cannot hold, whatever solved them: by how much they gape.
#include "solve/gaping_joints.h"
#include "scene/joint_freedom.h"
#include "support/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace plumb::test {
namespace {

constexpr double kWay = 0.3;  // of what pulls joints apart [m], [rad]

double sum_of(const std::vector<double>& errors) {
    return std::accumulate(errors.begin(), errors.end(), 0.0);
}

/// A cube of 0.2 m that a fixed joint holds, and a kinematic one beside it which moves along and
/// turns about the two given, by kWay in half a second.
Scene pulled_scene(JointMethod method, const Vector& along, const Vector& about) {
    Scene s;
    s.settings.gravity.setZero();
    s.settings.joints = method;
    add_body(s, box(0.1, 0.1, 0.1), {0, 0, 0});
    BodySpec& puller = add_body(s, box(0.1, 0.1, 0.1), {0.5, 0, 0}, Motion::kinematic);
    puller.velocity = 2 * kWay * along, puller.angular_velocity = 2 * kWay * about;
    add_joint(s, JointKind::fixed, 0, kNoIndex, {0, 0, 0});
    return s;
}

StepReport last_of(Simulation& simulation, double seconds) {
    StepReport report;
    while (simulation.time() < seconds - 1e-9) report = simulation.step();
    return report;
}

class Gaping : public testing::TestWithParam<JointMethod> {};
INSTANTIATE_TEST_SUITE_P(, Gaping, testing::Values(JointMethod::auto_, JointMethod::iterate),
                         [](const auto& method) {
                             return method.param == JointMethod::iterate ? "iterate" : "auto";
                         });

/// One of the two joints gives way, or both do: together by as much as they are pulled apart.
TEST_P(Gaping, OfEachKindAreTold) {
    for (std::size_t kind = 0; kind < std::size(kLocked); ++kind) {
        for (std::uint32_t k = 0; k < kJointAxes; ++k) {
            JointSpec joint;
            joint.kind = static_cast<JointKind>(kind);
            joint.locked = {true, false, true, false, true, false};  // where it says
            if (joint.kind == JointKind::distance) joint.anchor_b = Vector(0.5, 0, 0);
            if (!locked_axes(joint)[k]) continue;
            const bool turns = k >= kTurnX;
            const Vector axis = Vector::Unit(k % 3);
            Scene s = pulled_scene(GetParam(), turns ? Vector(Vector::Zero()) : axis,
                                   turns ? axis : Vector(Vector::Zero()));
            joint.body_a = 0, joint.body_b = 1;
            s.joints.push_back(joint);
            Simulation simulation(s, colliders(), "reference");
            const GapingJoints gaping = last_of(simulation, 0.5).gaping;

            const World& world = simulation.world();
            const std::vector<double> errors =
                turns ? joint_turn_errors(world) : joint_errors(world);
            EXPECT_GT(sum_of(errors), 0.99 * kWay) << "kind " << kind << " axis " << k;
            EXPECT_GE(gaping.joints, 1u) << "kind " << kind << " axis " << k;
            const double worst = *std::max_element(errors.begin(), errors.end());
            EXPECT_EQ(turns ? gaping.about : gaping.along, worst);
            EXPECT_EQ(errors[turns ? gaping.most_turned : gaping.widest], worst);
        }
    }
}

/// A rope, a slider, a hinge and a cone that go to 0.1, and are pulled to 0.3.
TEST_P(Gaping, OfWhichALimitIsPassedAreTold) {
    constexpr double kMost = 0.1;
    for (const JointKind kind :
         {JointKind::distance, JointKind::slider, JointKind::hinge, JointKind::cone_twist}) {
        const bool turns = kind == JointKind::hinge || kind == JointKind::cone_twist;
        const std::uint32_t axis = kind == JointKind::hinge        ? kTurnX
                                   : kind == JointKind::cone_twist ? kTurnY
                                                                   : kAlongX;
        const bool swings = kind == JointKind::cone_twist;
        Scene s = pulled_scene(GetParam(), turns ? Vector(0, 0, 0) : Vector(1, 0, 0),
                               swings  ? Vector(0, 1, 0)
                               : turns ? Vector(1, 0, 0)
                                       : Vector(0, 0, 0));
        JointSpec& joint = add_joint(s, kind, 0, 1, {0.5, 0, 0});
        joint.axes[axis].upper = kMost;
        if (!swings) joint.axes[axis].lower = -kMost;
        if (kind == JointKind::distance) {
            joint.anchor = {0, 0, 0}, joint.anchor_b = Vector(0.5, 0, 0);
            joint.axes[axis].lower = 0, joint.axes[axis].upper = 0.5 + kMost;
        }
        Simulation simulation(s, colliders(), "reference");
        const GapingJoints gaping = last_of(simulation, 0.5).gaping;

        const World& world = simulation.world();
        const double told = turns ? gaping.about : gaping.along;
        EXPECT_GT(sum_of(turns ? joint_turn_errors(world) : joint_errors(world)),
                  0.99 * (kWay - kMost));
        EXPECT_GT(told, 0.49 * (kWay - kMost)) << "kind " << static_cast<int>(kind);
        EXPECT_GE(gaping.joints, 1u);
    }
}

/// Two wheels that are tied as gears; one stands, and a kinematic body turns the other.
TEST_P(Gaping, OfCouplingsThatSlipAreTold) {
    Scene s = pulled_scene(GetParam(), {0, 0, 0}, {1, 0, 0});
    add_body(s, box(0.1, 0.1, 0.1), {0.5, 1, 0});
    s.bodies[1].placement.position = {0.5, 1, 0};
    add_joint(s, JointKind::fixed, 2, 1, {0.5, 1, 0});
    add_joint(s, JointKind::hinge, 0, kNoIndex, {0, 0, 0});
    add_joint(s, JointKind::hinge, 2, kNoIndex, {0.5, 1, 0});
    CouplingSpec gear;
    gear.joint_a = 2, gear.joint_b = 3, gear.ratio = -1;
    s.couplings.push_back(gear);
    Simulation simulation(s, colliders(), "reference");
    const GapingJoints gaping = last_of(simulation, 0.5).gaping;

    const double slipped = coupling_errors(simulation.world())[0];
    EXPECT_GT(slipped + sum_of(joint_turn_errors(simulation.world())), 0.99 * kWay);
    EXPECT_EQ(gaping.couplings, 1u);
    EXPECT_EQ(gaping.coupled, slipped);
    EXPECT_EQ(gaping.worst_coupling, 0u);
}

/// Rows that close a joint know the sine of its turn; half a turn is told as one.
TEST(GapingTurns, AreWholeAngles) {
    constexpr double kAngle = 3.1;
    for (const JointKind kind : {JointKind::orientation, JointKind::parallel}) {
        Scene s;
        add_body(s, box(0.1, 0.1, 0.1), {0, 0, 0});
        add_joint(s, kind, 0, kNoIndex, {0, 0, 0});
        Simulation simulation(s, colliders(), "reference");
        Joint joint = simulation.world().joints.joints[0];
        joint.frame_b.rotation = exponential_map({0, 0, kAngle}) * joint.frame_b.rotation;
        const JointPose pose = joint_pose(simulation.world().bodies, joint);
        EXPECT_NEAR(locked_error(joint, pose).about, kAngle, 1e-12);
    }
}

/// A weight on a soft joint, one on a joint that broke, and a pendulum.
TEST_P(Gaping, AreNotThoseThatMayGiveWay) {
    Scene s;
    s.settings.joints = GetParam();
    for (int i = 0; i < 3; ++i) {
        add_body(s, box(0.1, 0.1, 0.1), {2.0 * i, 0, 0}).mass = 10;
        add_joint(s, JointKind::ball, s.bodies.size() - 1, kNoIndex, {2.0 * i + 0.2, 0, 0});
    }
    s.joints[0].compliance = 1e-3;
    s.joints[1].breaking_force = 1;
    Simulation simulation(s, colliders(), "reference");
    const StepReport report = last_of(simulation, 0.3);
    const World& world = simulation.world();
    EXPECT_GT(joint_gap(world.bodies, world.joints.joints[0]), 0.01);
    EXPECT_TRUE(simulation.is_broken(1));
    EXPECT_EQ(report.gaping.joints, 0u);
    EXPECT_EQ(joint_errors(world)[0], 0);
    EXPECT_EQ(joint_errors(world)[1], 0);
}

/// 0.1 mm is 5 % of a cube of 2 mm, and nothing that anyone sees of one of 2 m.
TEST_P(Gaping, GapeByTheSizeOfTheirBodies) {
    for (const double half : {0.001, 1.0}) {
        Scene s = pulled_scene(GetParam(), {0, 1e-4 / kWay, 0}, {0, 0, 0});
        s.geometries[s.bodies[0].geometry] = box(half, half, half);
        s.geometries[s.bodies[1].geometry] = box(half, half, half);
        add_joint(s, JointKind::ball, 0, 1, {0, 0, 0});
        Simulation simulation(s, colliders(), "reference");
        const StepReport report = last_of(simulation, 0.5);
        EXPECT_GT(sum_of(joint_errors(simulation.world())), 0.99e-4);
        EXPECT_EQ(report.gaping.joints > 0, half < 1) << half;
    }
}

TEST(GapingTrees, ThatAreNotSolvedAreTold) {
    Scene s;
    s.settings.position_iterations = 0;
    add_body(s, box(0.1, 0.1, 0.1), {0, 0, 0});
    add_joint(s, JointKind::ball, 0, kNoIndex, {0, 0.1, 0});
    Simulation simulation(s, colliders(), "reference");
    const StepReport report = last_of(simulation, 0.1);
    EXPECT_EQ(report.gaping.joints, 1u);
    EXPECT_GT(report.gaping.along, 0.9 * 0.5 * kGravity * 0.01);
}

/// A tree that touches nothing is known to be closed; where it stands past a limit is told.
TEST(GapingTrees, ThatStandPastALimitAreTold) {
    Scene s;
    s.settings.gravity.setZero();
    add_body(s, box(0.1, 0.1, 0.1), {0, 0, 0});
    add_joint(s, JointKind::hinge, 0, kNoIndex, {0, 0.1, 0}).axes[kTurnX].lower = 0.5;
    Simulation simulation(s, colliders(), "reference");
    const StepReport report = simulation.step();
    EXPECT_EQ(report.unsolved_trees, 0u);
    EXPECT_EQ(report.gaping.joints, 1u);
    EXPECT_NEAR(report.gaping.about, 0.5 - joint_position(simulation, 0, kTurnX), 1e-12);
    EXPECT_GT(report.gaping.about, 0.4);
}

}  // namespace
}  // namespace plumb::test
