// SPDX-License-Identifier: MIT
/// What drives the joints of trees is solved with them: nothing creeps, and what acts along one
/// axis adds up, against formulas.
#include "measure/measure.h"
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::test {
namespace {

constexpr int kLinks = 4;

/// Rods of 1 m and 8 kg in a row along x, hinged about z at x = 0, 1, 2 …, the first to the world.
Scene arm(Precision precision, double dt, std::uint32_t substeps) {
    Scene s;
    s.settings.precision = precision;
    s.settings.dt = dt, s.settings.substeps = substeps;
    for (std::uint32_t i = 0; i < kLinks; ++i) {
        add_body(s, box(0.5, 0.1, 0.1), {i + 0.5, 0, 0});
        s.bodies.back().mass = 8, s.bodies.back().mask = 0;
        JointSpec hinge;
        hinge.kind = JointKind::hinge;
        hinge.body_a = i;
        if (i > 0) hinge.body_b = i - 1;
        hinge.anchor = {double(i), 0, 0};
        hinge.frame = Eigen::AngleAxisd(-std::numbers::pi / 2, Vector::UnitY());
        s.joints.push_back(hinge);
    }
    return s;
}

/// Of all that hangs on joint i, about it [N m].
double weight_about(int i) {
    const double length = kLinks - i;
    return 8 * length * kGravity * length / 2;
}

double widest_angle(Simulation& s) {
    double widest = 0;
    for (std::uint32_t i = 0; i < kLinks; ++i)
        widest = std::max(widest, std::abs(s.joint_motion(i, kTurnX).position));
    return widest;
}

class DrivenTrees : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, DrivenTrees, each_precision(), precision_name);

TEST_P(DrivenTrees, FrictionHoldsALoadedArmWithoutCreep) {
    Scene s = arm(GetParam(), 0.01, 1);
    for (int i = 0; i < kLinks; ++i)
        s.joints[std::size_t(i)].axes[kTurnX].friction = 1.02 * weight_about(i);
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 5);
    EXPECT_LT(widest_angle(simulation), 1e-6);
    for (std::uint32_t i = 0; i < kLinks; ++i)
        EXPECT_NEAR(simulation.joint_load(i).torque.norm(), weight_about(int(i)),
                    1e-4 * weight_about(int(i)));
}

TEST_P(DrivenTrees, FrictionThatIsTooWeakGivesWay) {
    Scene s = arm(GetParam(), 0.01, 1);
    for (int i = 0; i < kLinks; ++i)
        s.joints[std::size_t(i)].axes[kTurnX].friction = (i == 1 ? 0.9 : 1.02) * weight_about(i);
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 0.5);
    EXPECT_GT(std::abs(simulation.joint_motion(1, kTurnX).position), 0.05);
    EXPECT_NEAR(simulation.joint_load(1).torque.norm(), 0.9 * weight_about(1),
                1e-3 * weight_about(1));
}

/// A motor that wants to turn has first to overcome the friction of its axis, and beyond the limit
/// neither counts.
TEST_P(DrivenTrees, MotorFrictionAndLimitOfOneAxisAddUp) {
    Scene s = arm(GetParam(), 0.005, 4);
    s.settings.gravity.setZero();
    s.bodies.resize(1), s.joints.resize(1);
    JointAxisSpec& axis = s.joints[0].axes[kTurnX];
    axis.motor.mode = MotorMode::velocity, axis.motor.target = 2, axis.motor.greatest = 10;
    axis.friction = 4, axis.upper = 3;
    Simulation simulation(s, colliders(), "reference");
    const double inertia = 8 * (1.0 / 3 + 0.2 * 0.2 / 12);  // about the end
    const double acceleration = (10 - 4) / inertia;
    run_for(simulation, 0.5);
    EXPECT_NEAR(simulation.joint_motion(0, kTurnX).velocity, 0.5 * acceleration,
                2e-3 * acceleration);
    run_for(simulation, 0.75);
    EXPECT_NEAR(simulation.joint_motion(0, kTurnX).velocity, 2, 1e-5);
    EXPECT_LT(simulation.joint_load(0).torque.x(), 1e-3);
    run_for(simulation, 2);
    EXPECT_NEAR(simulation.joint_motion(0, kTurnX).position, 3, 1e-5);
    EXPECT_NEAR(simulation.joint_motion(0, kTurnX).velocity, 0, 1e-5);
}

/// Each limit of the hanging arm bears all that hangs below it, at rest.
TEST_P(DrivenTrees, LimitsOfAWholeChainHoldTogether) {
    Scene s = arm(GetParam(), 0.01, 2);
    for (JointSpec& joint : s.joints)
        joint.axes[kTurnX].lower = -0.1, joint.axes[kTurnX].upper = 0.1;
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 10);
    EXPECT_LT(widest_angle(simulation), 0.1 + 1e-5);
    double moment = 0, angle = 0, reach = 0;
    for (int i = kLinks; i-- > 0;) {  // all at their limits: link i is turned by 0.1 (i + 1)
        angle = 0.1 * (i + 1);
        moment += 8 * kGravity * 0.5 * std::cos(angle) + reach * std::cos(angle);
        reach += 8 * kGravity;
        EXPECT_NEAR(simulation.joint_load(std::uint32_t(i)).torque.norm(), moment, 0.01 * moment);
    }
}

/// The robot's own weight in the air: motors that hold every joint of a free tree change nothing of
/// its fall.
TEST_P(DrivenTrees, MotorsOfAFreeTreeKeepItsMomentum) {
    Scene s = arm(GetParam(), 0.01, 4);
    s.joints.erase(s.joints.begin());
    s.settings.gravity.setZero();
    for (std::size_t i = 0; i < s.joints.size(); ++i) {
        JointMotor& motor = s.joints[i].axes[kTurnX].motor;
        motor.mode = MotorMode::velocity;
        motor.target = i % 2 == 0 ? 0.3 : -0.5, motor.greatest = 30;
    }
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    EXPECT_NEAR(simulation.joint_motion(0, kTurnX).velocity, 0.3, 1e-4);
    EXPECT_NEAR(simulation.joint_motion(1, kTurnX).velocity, -0.5, 1e-4);
    EXPECT_LT(linear_momentum(simulation.world()).norm(), 1e-5);
    EXPECT_LT(angular_momentum(simulation.world()).norm(), 1e-3);
}

/// Two to five rods of one length in a line, the last up to a hundred times as heavy, on hinges
/// that rub or brake with anything from nothing to many times what all of them would weigh on the
/// first one; some of those that rub have limits.
Scene rubbing_chain(Precision precision, Random& random) {
    constexpr double kShares[] = {0, 0.003, 0.01, 0.1, 1, 3, 10};
    Scene s;
    s.settings.precision = precision;
    const std::uint32_t rods = 2 + random.below(4);
    const double length = random.number(0.1, 0.6), load = std::pow(10, random.number(1, 2));
    const double angle = random.number(0, std::numbers::pi / 2);
    const double mass = 10 * length * length * length;
    const double weight = mass * (rods - 1 + load) * kGravity * rods * length;
    const Vector along(std::sin(angle), -std::cos(angle), 0);
    const bool brakes = random.below(3) == 0, ends = random.below(3) == 0;
    for (std::uint32_t i = 0; i < rods; ++i) {
        BodySpec& body = add_body(s, box(0.05 * length, 0.5 * length, 0.05 * length),
                                  along * length * (i + 0.5));
        body.mass = i + 1 < rods ? mass : load * mass, body.mask = 0;
        body.placement.rotation = rotation_between(-Vector::UnitY(), along);
        JointSpec hinge;
        hinge.kind = JointKind::hinge;
        hinge.body_a = i, hinge.body_b = i > 0 ? i - 1 : kNoIndex;
        hinge.anchor = along * length * i;
        hinge.frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
        JointAxisSpec& axis = hinge.axes[kTurnX];
        const double most = weight * kShares[random.below(7)];
        if (brakes && most > 0)
            axis.motor.mode = MotorMode::velocity, axis.motor.greatest = most;
        else if (!brakes)
            axis.friction = most;
        if (ends && !brakes && random.below(2) == 0)
            axis.lower = -random.number(0.05, 1), axis.upper = random.number(0.05, 1);
        s.joints.push_back(hinge);
    }
    return s;
}

/// What velocities of the middle of a substep of length h [s] may miss of the energy at its end.
double half_a_push(const World& world, double h) {
    return 0.5 * h * kGravity * linear_momentum(world).norm();
}

/// At any time, from rest: what rubs, brakes or ends a turn only ever takes energy. So it is as
/// long as each axis is on the piece of its force law on which it is solved; one step that ends on
/// another throws light rods about with many times what they fell by.
TEST_P(DrivenTrees, FrictionBrakesAndLimitsNeverAddEnergy) {
    Random random(GetParam() == Precision::single ? 51 : 52);
    for (int draw = 0; draw < 150; ++draw) {
        Scene s = rubbing_chain(GetParam(), random);
        if (draw % 3 == 0) use_fine_steps(s.settings);
        if (draw % 3 == 1) s.settings.dt = 0.01;
        if (draw % 3 == 2)
            s.settings.dt = random.number(0.001, 0.017), s.settings.substeps = 1 + random.below(40);
        const double h = s.settings.dt / s.settings.substeps;
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.joints.size() << " rods, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), "reference");
        double mass = 0;
        for (const double m : simulation.world().bodies.mass) mass += m;
        const double size = mass * kGravity * 2 * s.bodies.back().placement.position.norm();
        double least = total_energy(simulation);
        while (simulation.time() < 1.5) {
            ASSERT_EQ(simulation.step().unsolved_trees, 0u) << "at " << simulation.time();
            const double energy = total_energy(simulation);
            const double missed = half_a_push(simulation.world(), h);
            ASSERT_LT(energy - missed, least + 1e-4 * size) << "at " << simulation.time();
            least = std::min(least, energy + missed);
        }
    }
}

}  // namespace
}  // namespace plumb::test
