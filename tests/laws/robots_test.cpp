// SPDX-License-Identifier: MIT
/// A robot from a URDF file: its bodies are where its masses are, its motors hold it up, and
/// without them its joints keep together as it falls.
#include "reader/robots/robot.h"
#include "support/random.h"
#include "support/scenes.h"
#include "ties/joint_state.h"

#include <algorithm>

namespace plumb::test {
namespace {

constexpr const char* kQuadruped = PLUMB_SAMPLES "/scenes/robots/quadruped.urdf";

class RobotLaws : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(
    , RobotLaws,
    testing::Combine(testing::Values(std::string("ode"), std::string("bullet")), each_precision()),
    where_name);

/// Bent legs, and the motors' limits those of the file.
RobotOptions standing() {
    RobotOptions options;
    options.hold = true;
    for (const std::string leg : {"front_left", "front_right", "hind_left", "hind_right"})
        options.positions[leg + "_swing"] = 0.7, options.positions[leg + "_knee"] = -1.4;
    return options;
}

TEST_P(RobotLaws, BodiesAreAtTheirCentresOfMass) {
    const Scene s = read_robot(kQuadruped);
    const Simulation simulation(s, colliders(), collider());
    const Bodies& b = simulation.world().bodies;
    // The trunk with the head, 0.3 m before and 0.04 m above it.
    EXPECT_NEAR(b.mass[0], 12.8, 1e-12);
    const Vector trunk = s.bodies[0].placement.position;
    EXPECT_LE((b.position[0] - trunk - 0.8 / 12.8 * Vector(0.3, 0.04, 0)).norm(), 1e-12);
    // The shape stays where the file has it.
    EXPECT_LE((geometry_placement(b, 0).position - trunk).norm(), 1e-12);
}

/// Each knee carries a quarter of the trunk and sags by less than a hundredth of a radian. What
/// stands does not slide.
TEST_P(RobotLaws, HeldJointsKeepItStanding) {
    Scene s = read_robot(kQuadruped, standing());
    s.settings.precision = std::get<1>(GetParam());
    Simulation simulation(s, colliders(), collider());
    const double height = simulation.world().bodies.position[0].y();
    run_for(simulation, 1);
    const Bodies& b = simulation.world().bodies;
    const Vector settled = b.position[0];
    run_for(simulation, 2);
    EXPECT_NEAR(b.position[0].y(), height, 0.7e-3);
    EXPECT_LE(b.velocity[0].norm(), 1e-6);
    EXPECT_LE((b.position[0] - settled).norm(), 1e-6) << "it slides";
    EXPECT_LE(widest_joint(simulation.world()), 5e-6);
}

/// Motors of a twentieth of the strength, 3 N m, cannot: a quarter of the weight, 53 N, on the
/// lever of a knee, 0.15 m, is 8 N m.
TEST_P(RobotLaws, WeakMotorsLetItDown) {
    Scene s = read_robot(kQuadruped, standing());
    s.settings.precision = std::get<1>(GetParam());
    for (JointSpec& joint : s.joints)
        for (JointAxisSpec& axis : joint.axes) axis.motor.greatest /= 20;
    Simulation simulation(s, colliders(), collider());
    const double height = simulation.world().bodies.position[0].y();
    run_for(simulation, 3);
    EXPECT_LE(simulation.world().bodies.position[0].y(), height - 0.1);
    EXPECT_LE(widest_joint(simulation.world()), 1e-3);
}

/// Dropped onto its feet at drawn settings, so that they come by up to 8 mm, of a radius of 0.12 m,
/// in a substep: its joints keep together while it lands, and it comes to stand.
TEST_P(RobotLaws, JointsHoldAsItLandsOnItsFeet) {
    Random random(21);
    for (int draw = 0; draw < 12; ++draw) {
        const double dt = draw == 0 ? 0.005 : random.number(0.002, 0.01);
        const std::uint32_t substeps = draw == 0 ? 1 : 1 + random.below(4);
        const double speed = std::min(2.8, 0.008 * substeps / dt);
        RobotOptions options = standing();
        options.placement.position.y() = random.number(0.3, 0.9) * speed * speed / (2 * 9.81);
        Scene s = read_robot(kQuadruped, options);
        s.settings.precision = std::get<1>(GetParam());
        s.settings.dt = dt, s.settings.substeps = substeps;
        SCOPED_TRACE(testing::Message() << "from " << options.placement.position.y() << " m, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        double worst = 0;
        while (simulation.time() < 2.5) {
            simulation.step();
            worst = std::max(worst, widest_joint(simulation.world()));
        }
        EXPECT_LE(worst, 1e-4);
        EXPECT_LE(widest_joint(simulation.world()), 1e-5);
        EXPECT_LE(fastest_point(simulation.world()), 1e-3);
    }
}

/// Thrown about without motors, so that its links come by up to 5 cm in a substep and it tumbles:
/// joints stay closed, and it comes to rest.
TEST_P(RobotLaws, LimpJointsHoldAsItTumbles) {
    Random random(22);
    for (int draw = 0; draw < 8; ++draw) {
        RobotOptions options = standing();
        options.hold = false;
        options.placement.position.y() = random.number(0.3, 1.2);
        options.placement.rotation = random.rotation();
        Scene s = read_robot(kQuadruped, options);
        s.settings.precision = std::get<1>(GetParam());
        s.settings.dt = draw == 0 ? 0.005 : random.number(0.003, 0.007);
        s.settings.substeps = draw == 0 ? 1 : 1 + random.below(2);
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", " << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        double worst = 0;
        while (simulation.time() < 4) {
            ASSERT_TRUE(simulation.step().finite);
            worst = std::max(worst, widest_joint(simulation.world()));
        }
        EXPECT_LE(worst, 1e-3);
        EXPECT_LE(widest_joint(simulation.world()), 1e-5);
        EXPECT_LE(fastest_point(simulation.world()), 1e-2);
    }
}

/// The coordinates of its joints [rad], [m].
std::vector<double> coordinates(const World& world) {
    std::vector<double> q;
    for (std::uint32_t i = 0; i < world.joints.size(); ++i)
        for (std::uint32_t axis = 0; axis < kJointAxes; ++axis)
            if (!world.joints.joints[i].locked[axis])
                q.push_back(joint_coordinate(world, i, axis).value);
    return q;
}

/// Legs that swing from a trunk which is held on its side, as a file for itself is read: of second
/// order in the step where no limit is reached and nothing rubs.
TEST_P(RobotLaws, SwingingLegsConvergeBySecondOrder) {
    RobotOptions options = standing();
    options.hold = options.self_collision = false;
    options.base = RobotBase::fixed;
    Scene s = read_robot(kQuadruped, options);
    s.settings.precision = std::get<1>(GetParam());
    s.settings.gravity = {0, 0, -9.81};
    for (JointSpec& joint : s.joints) joint.axes[kTurnX] = {};
    const auto swung = [&](double dt) {
        s.settings.dt = dt;
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 0.3);
        return coordinates(simulation.world());
    };
    const std::vector<double> fine = swung(0.0005);
    const auto error = [&](const std::vector<double>& q) {
        double worst = 0;
        for (std::size_t i = 0; i < q.size(); ++i)
            worst = std::max(worst, std::abs(q[i] - fine[i]));
        return worst;
    };
    const double at_5_ms = error(swung(0.005)), at_10_ms = error(swung(0.01));
    EXPECT_LE(at_5_ms, 1e-3);
    EXPECT_GE(at_10_ms, 3 * at_5_ms);
}
}  // namespace
}  // namespace plumb::test
