// SPDX-License-Identifier: MIT
/// A stage exists only when the scene calls for it, and the ledger tells what each cost.
#include "scene/error.h"
#include "support/scenes.h"

namespace plumb::test {
namespace {

bool runs(const Scene& scene, Effect effect) { return make_plan(build_world(scene)).runs(effect); }

Scene two_bodies() {
    Scene s;
    add_ground(s);
    add_body(s, box(0.5, 0.5, 0.5), {0, 0.5, 0});
    return s;
}

TEST(Effects, FollowTheScene) {
    Scene s = two_bodies();
    EXPECT_TRUE(runs(s, Effect::contacts));
    EXPECT_TRUE(runs(s, Effect::friction));
    EXPECT_TRUE(runs(s, Effect::sticking_anchors));
    EXPECT_FALSE(runs(s, Effect::restitution));
    EXPECT_FALSE(runs(s, Effect::turning_friction));
    EXPECT_FALSE(runs(s, Effect::gyroscopic)) << "a cube has equal moments";
    EXPECT_FALSE(runs(s, Effect::joints));
    EXPECT_FALSE(runs(s, Effect::kinematics));
    EXPECT_FALSE(runs(s, Effect::shock_propagation));

    s.materials[0].friction = 0;
    EXPECT_FALSE(runs(s, Effect::friction));
    EXPECT_FALSE(runs(s, Effect::sticking_anchors));
    s.materials[0].restitution = 0.5;
    EXPECT_TRUE(runs(s, Effect::restitution));
    add_body(s, box(0.1, 0.2, 0.3), {3, 3, 3});
    EXPECT_TRUE(runs(s, Effect::gyroscopic));
}

TEST(Effects, CanBeRequiredAndForbidden) {
    Scene s = two_bodies();
    s.settings.require = {"shock_propagation"};
    s.settings.forbid = {"friction"};
    const Plan plan = make_plan(build_world(s));
    EXPECT_TRUE(plan.runs(Effect::shock_propagation));
    EXPECT_FALSE(plan.runs(Effect::friction));
    ASSERT_EQ(plan.warnings.size(), 1u);
    EXPECT_NE(plan.warnings[0].find("friction"), std::string::npos);
    s.settings.require = {"shok"};
    EXPECT_THROW(make_plan(build_world(s)), SceneError);
}

/// Where body 1 is after a while.
Vector end_of(const Scene& s, double seconds) {
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, seconds);
    return simulation.world().bodies.position[1];
}

/// Two boxes, one on the other, that slide along the ground.
Scene sliding_boxes() {
    Scene s;
    add_ground(s);
    for (int i = 0; i < 2; ++i)
        add_body(s, box(0.5, 0.5, 0.5), {0, 0.5 + i, 0}).velocity = {2, 0, 0};
    return s;
}

TEST(Effects, FrictionThatIsForbiddenIsNowhere) {
    for (const double rolling : {0.0, 0.01}) {
        for (const std::uint32_t exact : {0u, 400u}) {
            Scene s = sliding_boxes();
            s.materials[0].rolling_friction = rolling;
            s.settings.exact_islands = exact;
            EXPECT_LT(end_of(s, 1).x(), 1.5);
            s.settings.forbid = {"friction"};
            EXPECT_NEAR(end_of(s, 1).x(), 2, 1e-3) << rolling << ", islands of " << exact;
        }
    }
}

TEST(Effects, TurningFrictionThatIsForbiddenIsNowhere) {
    for (const std::uint32_t exact : {0u, 400u}) {
        Scene s;
        s.materials[0].rolling_friction = 0.1;
        s.settings.exact_islands = exact;
        add_ground(s);
        for (int i = 0; i < 2; ++i) {
            BodySpec& ball = add_body(s, sphere(0.5), {0.9999 * i, 0.5, 0});
            ball.velocity = {2, 0, 0};
            ball.angular_velocity = {0, 0, -4};
        }
        const double held = end_of(s, 1).x();
        s.settings.forbid = {"turning_friction"};
        const double free = end_of(s, 1).x();
        s.settings.forbid = {};
        s.materials[0].rolling_friction = 0;
        EXPECT_EQ(free, end_of(s, 1).x()) << "islands of " << exact;
        EXPECT_LT(held, free - 0.1);
    }
}

TEST(Effects, WhatAScriptOrAVelocityMovesStandsStillWithoutKinematics) {
    Scene s;
    add_ground(s);
    BodySpec& belt = add_body(s, box(0.5, 0.5, 0.5), {0, 3, 0}, Motion::kinematic);
    belt.velocity = {1, 0, 0};
    add_body(s, box(0.5, 0.5, 0.5), {0, 4, 0});
    EXPECT_NEAR(end_of(s, 1).x(), 1, 1e-9);
    s.settings.forbid = {"kinematics"};
    EXPECT_EQ(end_of(s, 1).x(), 0);
}

TEST(Effects, WhatIsNotCalledForIsNotCalled) {
    Scene s = two_bodies();
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 0.2);
    for (Stage stage : {Stage::restitution, Stage::kinematics, Stage::shock})
        EXPECT_EQ(simulation.ledger().calls[static_cast<std::size_t>(stage)], 0u);
}

TEST(Effects, TheLedgerAccountsForTheStep) {
    Scene s;
    add_ground(s);
    for (int i = 0; i < 500; ++i)
        add_body(s, box(0.2, 0.2, 0.2),
                 {0.45 * (i % 8), 0.3 + 0.45 * (i / 64), 0.45 * (i / 8 % 8)});
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 0.5);
    double stages = 0, steps = 0;
    for (int i = 0; i < 50; ++i) {
        simulation.step();
        for (std::uint64_t ns : simulation.ledger().nanoseconds) stages += static_cast<double>(ns);
        steps += static_cast<double>(simulation.ledger().step_nanoseconds);
    }
    EXPECT_GT(stages / steps, 0.95);
}

TEST(Effects, ThePapersPresetRunsAndHoldsABoxOnASlope) {
    Scene s;
    apply_paper_preset(s.settings);
    const Rotation tilt(Eigen::AngleAxisd(0.35, Vector::UnitZ()));
    BodySpec& slope = add_body(s, box(50, 1, 50), tilt * Vector(0, -1, 0), Motion::fixed);
    slope.placement.rotation = tilt;
    BodySpec& b = add_body(s, box(0.5, 0.5, 0.5), tilt * Vector(0, 0.5, 0));
    b.placement.rotation = tilt;
    Simulation simulation(s, colliders(), "reference");
    const Vector start = simulation.world().bodies.position[1];
    run_for(simulation, 5);
    EXPECT_LT((simulation.world().bodies.position[1] - start).norm(), 0.01);
}

}  // namespace
}  // namespace plumb::test
