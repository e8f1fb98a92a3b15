// SPDX-License-Identifier: MIT
/// Joints that give way, and the bodies they kept apart.
#include "support/scenes.h"

namespace plumb::test {
namespace {

class Breaking : public OnEveryCollider {
protected:
    /// A cube of 1 m and 1000 kg, fixed half a metre above a fixed shelf by a joint that bears
    /// `share` of its weight.
    Scene hung(double share) const {
        Scene s = scene();
        use_fine_steps(s.settings);
        add_body(s, box(0.5, 0.5, 0.5), {0, 1.5, 0});
        add_body(s, box(1, 0.25, 1), {0, 0.25, 0}, Motion::fixed);
        JointSpec joint;
        joint.kind = JointKind::fixed;
        joint.body_a = 0, joint.body_b = 1;
        joint.anchor = {0, 1.5, 0};
        joint.breaking_force = share * 1000 * 9.81;
        s.joints.push_back(joint);
        return s;
    }
    /// Height of the cube after a second [m].
    double height(const Scene& s) const {
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 1);
        return simulation.world().bodies.position[0].y();
    }
};
INSTANTIATE_TEST_SUITE_P(, Breaking, every_collider(), where_name);

TEST_P(Breaking, BodiesMeetOnceTheirJointGaveWay) {
    EXPECT_NEAR(height(hung(1.1)), 1.5, 1e-6);
    EXPECT_NEAR(height(hung(0.9)), 1, 1e-4);
}

TEST_P(Breaking, AnotherJointStillKeepsThemApart) {
    Scene s = hung(0.9);
    JointSpec rail;
    rail.kind = JointKind::slider;
    rail.body_a = 0, rail.body_b = 1;
    rail.anchor = {0, 1.5, 0};
    rail.frame = rotation_between(Vector::UnitX(), Vector::UnitY());
    s.joints.push_back(rail);
    EXPECT_LT(height(s), -2);
    s.joints[1].collide = true;
    EXPECT_NEAR(height(s), 1, 1e-4) << "it does not where it lets them collide";
}

TEST_P(Breaking, ScenesMayKeepThemApart) {
    Scene s = hung(0.9);
    s.apart.push_back({0, 1});
    EXPECT_LT(height(s), -2);
}

}  // namespace
}  // namespace plumb::test
