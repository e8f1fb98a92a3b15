// SPDX-License-Identifier: MIT
/// Joints that hold a point far outside of a body, where of the point's inertia the body's mass is
/// a share that rounding eats.
#include "support/scenes.h"

#include "scene/error.h"
#include "scene/joint_freedom.h"

#include <cmath>

namespace plumb::test {
namespace {

/// A box of radii of gyration around 0.2 m, on a joint of which the anchor is so far away.
Scene far_scene(JointKind kind, double arm) {
    Scene s;
    s.settings.dt = 0.01, s.settings.substeps = 4;
    add_body(s, box(0.1, 0.2, 0.3), Vector::Zero());
    JointSpec joint;
    joint.kind = kind;
    joint.body_a = 0;
    joint.anchor = Vector(-0.8, 0.5, 0.33).normalized() * arm;
    joint.frame = rotation_between(Vector::UnitX(), Vector(0, 0.3, 1));
    if (kind == JointKind::distance) joint.anchor_b = joint.anchor + Vector(0, 1, 0);
    if (kind == JointKind::six_axis) joint.locked = {true, false, false, false, true, false};
    s.joints.push_back(joint);
    return s;
}

using Solver = std::tuple<Precision, JointMethod>;

std::string name_of(const testing::TestParamInfo<Solver>& which) {
    const auto [precision, method] = which.param;
    return word_of(precision) + (method == JointMethod::tree ? "Tree" : "Iterate");
}

class FarAnchors : public testing::TestWithParam<Solver> {};
INSTANTIATE_TEST_SUITE_P(, FarAnchors,
                         testing::Combine(each_precision(),
                                          testing::Values(JointMethod::iterate, JointMethod::tree)),
                         name_of);

/// Whatever a joint locks, it holds the anchor to a few millionths of the arm; but a rod that is
/// short beside its arm swings too fast for its steps, and only stays finite.
TEST_P(FarAnchors, AreHeldAsFarAsTheyMayBe) {
    for (std::size_t kind = 0; kind < std::size(kLocked); ++kind)
        for (const double arm : {10.0, 100.0, 300.0, 1e3, 2e3, 5e3, 1e4}) {
            Scene s = far_scene(static_cast<JointKind>(kind), arm);
            std::tie(s.settings.precision, s.settings.joints) = GetParam();
            Simulation simulation(s, colliders(), "reference");
            double worst = 0;
            for (int i = 0; i < 100; ++i) {
                ASSERT_TRUE(simulation.step().finite) << kind << " at " << arm << " m";
                worst = std::max(worst, joint_errors(simulation.world())[0]);
            }
            if (static_cast<JointKind>(kind) == JointKind::distance) continue;
            EXPECT_LT(worst, 5e-6 * arm) << kind << " at " << arm << " m";
        }
}

TEST(FarAnchor, IsRefusedBeyondThat) {
    for (const double arm : {1e5, 1e9}) {
        const Scene s = far_scene(JointKind::hinge, arm * 0.9);
        try {
            Simulation simulation(s, colliders(), "reference");
            FAIL() << "an anchor " << arm << " m away";
        } catch (const SceneError& error) {
            EXPECT_EQ(error.pointer(), "/joints/0/anchor");
            EXPECT_NE(std::string(error.what()).find("radius of gyration"), std::string::npos);
        }
    }
}

/// About the anchor's direction a thin rod turns easily, which moves no anchor.
TEST(FarAnchor, IsMeasuredByTheInertiaThatItMeets) {
    Scene s = far_scene(JointKind::ball, 1);
    s.bodies[0].mass = 1;
    s.bodies[0].inertia = Vector(1e-12, 1, 1);
    s.joints[0].anchor = {-10, 0, 0};
    Simulation along(s, colliders(), "reference");
    EXPECT_TRUE(along.step().finite);
    s.joints[0].anchor = {0, -10, 0};
    EXPECT_THROW(Simulation(s, colliders(), "reference"), SceneError);
}

}  // namespace
}  // namespace plumb::test
