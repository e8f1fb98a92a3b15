// SPDX-License-Identifier: MIT
/// A robot from a URDF file: its bodies are where its masses are, its motors hold it up, and
/// without them its joints keep together as it falls.
#include "reader/urdf.h"
#include "support/scenes.h"

namespace plumb::test {
namespace {

constexpr const char* kQuadruped = PLUMB_SAMPLES "/scenes/robots/quadruped.urdf";

class RobotLaws : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(
    , RobotLaws,
    testing::Combine(testing::Values(std::string("ode"), std::string("bullet")), each_precision()),
    where_name);

/// Bent legs, and the motors' limits those of the file.
UrdfOptions standing() {
    UrdfOptions options;
    options.hold = true;
    for (const std::string leg : {"front_left", "front_right", "hind_left", "hind_right"})
        options.positions[leg + "_swing"] = 0.7, options.positions[leg + "_knee"] = -1.4;
    return options;
}

double worst_joint(const Simulation& simulation) {
    double worst = 0;
    for (double error : joint_errors(simulation.world())) worst = std::max(worst, error);
    return worst;
}

TEST_P(RobotLaws, BodiesAreAtTheirCentresOfMass) {
    const Scene s = read_urdf(kQuadruped);
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
    Scene s = read_urdf(kQuadruped, standing());
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
    EXPECT_LE(worst_joint(simulation), 5e-6);
}

/// Motors of a twentieth of the strength, 3 N m, cannot: a quarter of the weight, 53 N, on the
/// lever of a knee, 0.15 m, is 8 N m.
TEST_P(RobotLaws, WeakMotorsLetItDown) {
    Scene s = read_urdf(kQuadruped, standing());
    s.settings.precision = std::get<1>(GetParam());
    for (JointSpec& joint : s.joints)
        for (JointAxisSpec& axis : joint.axes) axis.motor.greatest /= 20;
    Simulation simulation(s, colliders(), collider());
    const double height = simulation.world().bodies.position[0].y();
    run_for(simulation, 3);
    EXPECT_LE(simulation.world().bodies.position[0].y(), height - 0.1);
    EXPECT_LE(worst_joint(simulation), 1e-3);
}

}  // namespace
}  // namespace plumb::test
