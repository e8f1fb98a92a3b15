// SPDX-License-Identifier: MIT
/// What no constraint may change: linear and angular momentum of bodies that only touch each other.
#include "support/scenes.h"

namespace plumb::test {
namespace {

class Momentum : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Momentum, every_collider(), where_name);

TEST_P(Momentum, SurvivesACollision) {
    Scene s = scene();
    s.settings.gravity.setZero();
    s.materials[0].restitution = 0.5;
    BodySpec& a = add_body(s, box(0.5, 0.4, 0.3), {-1, 0.2, 0.1});
    a.velocity = {2, 0, 0};
    a.angular_velocity = {1, 2, 0.5};
    add_body(s, box(0.3, 0.5, 0.6), {1, 0, 0}).velocity = {-1, 0.1, 0};
    Simulation simulation(s, colliders(), collider());
    const Vector p0 = linear_momentum(simulation.world()),
                 l0 = angular_momentum(simulation.world());
    const double e0 = kinetic_energy(simulation.world());
    run_for(simulation, 2);
    EXPECT_LT(kinetic_energy(simulation.world()), 0.98 * e0) << "they must have met";
    const double bound = s.settings.precision == Precision::single ? 1e-5 : 1e-10;
    EXPECT_LT((linear_momentum(simulation.world()) - p0).norm(), bound * 1000);
    // the impulses act at the arms of the step's start: angular momentum errs by h of the impulse
    EXPECT_LT((angular_momentum(simulation.world()) - l0).norm() / l0.norm(), 0.01);
}

TEST_P(Momentum, SurvivesABallJoint) {
    Scene s = scene();
    use_fine_steps(s.settings);
    s.settings.gravity.setZero();
    add_body(s, box(0.5, 0.1, 0.1), {0, 0, 0}).angular_velocity = {0, 2, 1};
    add_body(s, box(0.5, 0.1, 0.1), {1, 0, 0}).velocity = {0, 0.5, 0};
    JointSpec joint;
    joint.body_a = 0, joint.body_b = 1;
    joint.anchor = {0.5, 0, 0};
    s.joints.push_back(joint);
    Simulation simulation(s, colliders(), collider());
    const Vector p0 = linear_momentum(simulation.world());
    run_for(simulation, 2);
    const double bound = s.settings.precision == Precision::single ? 1e-5 : 1e-10;
    EXPECT_LT((linear_momentum(simulation.world()) - p0).norm() / p0.norm(), bound);
    EXPECT_LT(joint_errors(simulation.world())[0], 1e-4);
}

}  // namespace
}  // namespace plumb::test
