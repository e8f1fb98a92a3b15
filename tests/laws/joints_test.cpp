// SPDX-License-Identifier: MIT
/// Every kind of joint: what it takes stays, what it leaves moves as if it were not there, and
/// nothing is lost between two bodies. 1/60 s × 20 substeps × 1 iteration.
#include "support/scenes.h"
#include "ties/joint_state.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

struct OneJointKind {
    JointKind kind;
    const char* name;
    std::array<bool, kJointAxes> locked;
};
constexpr OneJointKind kOneJointKinds[] = {
    {JointKind::ball, "ball", {true, true, true, false, false, false}},
    {JointKind::point_on_line, "point_on_line", {false, true, true, false, false, false}},
    {JointKind::point_on_plane, "point_on_plane", {true, false, false, false, false, false}},
    {JointKind::orientation, "orientation", {false, false, false, true, true, true}},
    {JointKind::parallel, "parallel", {false, false, false, false, true, true}},
    {JointKind::perpendicular, "perpendicular", {false, false, false, false, false, true}},
    {JointKind::fixed, "fixed", {true, true, true, true, true, true}},
    {JointKind::hinge, "hinge", {true, true, true, false, true, true}},
    {JointKind::universal, "universal", {true, true, true, false, false, true}},
    {JointKind::slider, "slider", {false, true, true, true, true, true}},
    {JointKind::cylindrical, "cylindrical", {false, true, true, false, true, true}},
    {JointKind::planar, "planar", {true, false, false, false, true, true}},
    {JointKind::cone_twist, "cone_twist", {true, true, true, false, false, false}},
    {JointKind::six_axis, "six_axis", {true, false, true, false, true, false}},
};

using OneJointCase = std::tuple<OneJointKind, Precision>;
class EveryJoint : public testing::TestWithParam<OneJointCase> {
protected:
    const OneJointKind& kind() const { return std::get<0>(GetParam()); }

    /// A cube of 1 m and 1000 kg on a joint to the world at its centre, turned anyhow.
    Scene scene() const {
        Scene s;
        use_fine_steps(s.settings);
        s.settings.precision = std::get<1>(GetParam());
        s.settings.gravity.setZero();
        add_body(s, box(0.5, 0.5, 0.5), {1, 2, 3});
        s.joints.push_back(joint());
        s.joints[0].anchor = {1, 2, 3};
        return s;
    }
    JointSpec joint() const {
        JointSpec spec;
        spec.kind = kind().kind;
        spec.locked = kind().locked;
        spec.body_a = 0;
        spec.frame = exponential_map({0.4, -0.7, 0.2});
        return spec;
    }
    Vector axis(int k) const { return joint().frame * Vector::Unit(k % 3); }
};
std::string joint_case_name(const testing::TestParamInfo<OneJointCase>& info) {
    return std::string(std::get<0>(info.param).name) + "_" + word_of(std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(, EveryJoint,
                         testing::Combine(testing::ValuesIn(kOneJointKinds), each_precision()),
                         joint_case_name);

/// Pushed along or turned about each axis in turn for 0.5 s: by ten times its weight where the
/// joint is locked, by a force that moves it 0.125 m or 0.125 rad where it is free.
TEST_P(EveryJoint, HoldsWhatItTakesAndLeavesTheRest) {
    constexpr double kTime = 0.5, kMass = 1000, kInertia = 1000.0 / 6;
    for (int k = 0; k < 6; ++k) {
        const bool locked = kind().locked[static_cast<std::size_t>(k)], turning = k >= 3;
        Scene s = scene();
        const double load = locked ? 10 * kMass * 9.81 : turning ? kInertia : kMass;
        (turning ? s.bodies[0].torque : s.bodies[0].force) = load * axis(k);
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, kTime);
        const World& world = simulation.world();
        EXPECT_LT(joint_errors(world)[0], 1e-5) << "axis " << k;
        EXPECT_LT(joint_turn_errors(world)[0], 1e-5) << "axis " << k;
        if (locked) continue;
        const JointPose pose = joint_pose(world.bodies, world.joints.joints[0]);
        const Vector moved = pose.axes_b.transpose() * (pose.point_a - pose.point_b);
        const Vector turned =
            rotation_vector(Rotation(Matrix3d(pose.axes_b.transpose() * pose.axes_a)));
        EXPECT_NEAR((turning ? turned : moved)[k % 3], 0.125, 0.01 * 0.125) << "axis " << k;
    }
}

/// All that is taken is loaded at once, with gravity, off the centre of mass.
TEST_P(EveryJoint, HoldsUnderItsWeightOffCentre) {
    Scene s = scene();
    s.settings.gravity = {0, -9.81, 0};
    s.joints[0].anchor = {1.4, 2.3, 2.8};
    Simulation simulation(s, colliders(), "reference");
    double parted = 0, turned = 0;
    for (int i = 0; i < 120; ++i) {
        simulation.step();
        parted = std::max(parted, joint_errors(simulation.world())[0]);
        turned = std::max(turned, joint_turn_errors(simulation.world())[0]);
    }
    EXPECT_LT(parted, 1e-5);
    EXPECT_LT(turned, 1e-5);
}

TEST_P(EveryJoint, KeepsTheMomentumOfTwoFreeBodies) {
    Scene s = scene();
    s.bodies[0].velocity = {0.3, -0.2, 0.1}, s.bodies[0].angular_velocity = {0.5, 1, -0.7};
    add_body(s, box(0.3, 0.4, 0.5), {2, 2.5, 3});
    s.bodies[1].velocity = {-0.1, 0.4, 0.2}, s.bodies[1].angular_velocity = {-1, 0.2, 0.4};
    s.joints[0].body_b = 1;
    s.joints[0].anchor = {1.5, 2.2, 3.1};
    Simulation simulation(s, colliders(), "reference");
    const Vector p0 = linear_momentum(simulation.world()),
                 l0 = angular_momentum(simulation.world());
    run_for(simulation, 2);
    const double rounding = std::get<1>(GetParam()) == Precision::single ? 1e-6 : 1e-11;
    EXPECT_LT((linear_momentum(simulation.world()) - p0).norm(), rounding * l0.norm());
    EXPECT_LT((angular_momentum(simulation.world()) - l0).norm(), rounding * l0.norm());
    EXPECT_LT(joint_errors(simulation.world())[0], 1e-5);
    EXPECT_LT(joint_turn_errors(simulation.world())[0], 1e-5);
}

/// Two weights on a rope over a pulley, which is two distances whose sum is kept: the heavier one
/// sinks with (m₁ − m₂)/(m₁ + m₂) g.
TEST(Pulley, AcceleratesAsAtwoodsMachine) {
    Scene s;
    use_fine_steps(s.settings);
    s.settings.precision = Precision::double_;
    const double masses[] = {3, 2};
    for (int i = 0; i < 2; ++i) {
        add_body(s, box(0.1, 0.1, 0.1), {1.0 * i, -0.5 * i, 0}).mass = masses[i];
        JointSpec rope;
        rope.kind = JointKind::distance;
        rope.body_a = static_cast<std::uint32_t>(i);
        rope.anchor = s.bodies[static_cast<std::size_t>(i)].placement.position;
        rope.anchor_b = Vector(i, 2, 0);
        rope.axes[kAlongX].lower = 0;
        s.joints.push_back(rope);
    }
    CouplingSpec coupling;
    coupling.joint_a = 0, coupling.joint_b = 1;
    coupling.axis_a = coupling.axis_b = kAlongX;
    coupling.ratio = -1;
    s.couplings.push_back(coupling);

    Simulation simulation(s, colliders(), "reference");
    EXPECT_DOUBLE_EQ(simulation.world().joints.couplings[0].offset, 4.5);
    run_for(simulation, 0.5);
    const double sunk = 0.5 * (9.81 / 5) * 0.25;
    EXPECT_NEAR(simulation.world().bodies.position[0].y(), -sunk, 0.005 * sunk);
    EXPECT_NEAR(simulation.world().bodies.position[1].y(), -0.5 + sunk, 0.005 * sunk);
}

/// A range that is shorter than the way of a substep has two ends all the same.
TEST(JointLimits, OfAShortRangeStopWhatIsFast) {
    for (const bool on_a_body : {false, true})
        for (const double lower : {-0.005, 0.0})
            for (const double speed : {5.0, -5.0, 1.0}) {
                Scene s;
                s.settings.gravity.setZero();
                s.settings.forbid = {"contacts"};
                add_body(s, box(0.1, 0.1, 0.1), Vector::Zero()).velocity = {speed, 0, 0};
                JointSpec joint;
                joint.kind = JointKind::slider, joint.body_a = 0;
                joint.axes[kAlongX].lower = lower, joint.axes[kAlongX].upper = 0.005;
                if (on_a_body) {
                    add_body(s, box(0.1, 0.1, 0.1), Vector::Zero()).mass = 1e6;
                    joint.body_b = 1;
                }
                s.joints.push_back(joint);
                Simulation simulation(s, colliders(), "reference");
                for (int i = 0; i < 20; ++i) {
                    simulation.step();
                    const double q = joint_position(simulation, 0, kAlongX);
                    EXPECT_LT(q, 0.005 + 1e-6) << speed << " m/s, from " << lower;
                    EXPECT_GT(q, lower - 1e-6) << speed << " m/s, from " << lower;
                }
            }
}

}  // namespace
}  // namespace plumb::test
