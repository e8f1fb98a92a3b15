// SPDX-License-Identifier: MIT
#include "effects/plan.h"

#include "support/scenes.h"
#include "support/soft.h"

namespace plumb::test {
namespace {

bool runs(const Scene& scene, Effect effect) { return make_plan(build_world(scene)).runs(effect); }

/// A box on the ground, which a cylinder may join.
Scene box_on_the_ground() {
    Scene s;
    add_ground(s);
    add_body(s, box(0.2, 0.2, 0.2), {0, 0.2, 0});
    return s;
}

TEST(Plan, RimsRunWhereShapesHaveThem) {
    Scene s = box_on_the_ground();
    EXPECT_FALSE(runs(s, Effect::rims));
    Geometry part = cylinder(0.2, 0.3), compound;
    compound.kind = ShapeKind::compound;
    compound.parts.push_back({part, {}});
    for (const Geometry& g : {part, compound}) {
        Scene with = s;
        add_body(with, g, {1, 0.3, 0});
        EXPECT_TRUE(runs(with, Effect::rims));
        with.settings.forbid = {"contacts"};
        EXPECT_FALSE(runs(with, Effect::rims));
    }
}

TEST(Plan, RimsLeaveNoTablesOnceTheLastIsGone) {
    Scene s = box_on_the_ground();
    add_body(s, cylinder(0.2, 0.3), {1, 0.3, 0});
    Simulation simulation(s, colliders(), "ode");
    simulation.step();
    const ContactTable& c = simulation.world().contacts;
    EXPECT_FALSE(c.rims.empty());
    simulation.remove_body(2);
    run_for(simulation, 0.1);
    EXPECT_GT(c.found.size(), 0u) << "the box";
    EXPECT_TRUE(c.rims.empty());
}

TEST(Plan, StillGroundRunsWhereSomethingStands) {
    Scene s = box_on_the_ground();
    EXPECT_TRUE(runs(s, Effect::still_ground));
    s.settings.shared_push = false;
    EXPECT_FALSE(runs(s, Effect::still_ground)) << "as in the paper";
    s.settings.shared_push = true;
    s.settings.forbid = {"contacts"};
    EXPECT_FALSE(runs(s, Effect::still_ground));
    s.settings.forbid.clear();
    s.bodies[0].motion = Motion::kinematic;
    EXPECT_TRUE(runs(s, Effect::still_ground)) << "it may come to stand still";
    s.bodies.erase(s.bodies.begin());
    EXPECT_FALSE(runs(s, Effect::still_ground));
}

TEST(Plan, AirDragRunsWhereAirMeetsASurface) {
    Scene s = box_on_the_ground();
    s.settings.wind = Vector(3, 0, 0);
    EXPECT_FALSE(runs(s, Effect::air_drag));
    add_soft(s, rope({0.5, 0.1, 0}, {1, 0.1, 0}, 2));
    EXPECT_FALSE(runs(s, Effect::air_drag)) << "a rope has no surface";
    add_soft(s, sheet({2, 2}, {1, 1}, {0, 2, 0}));
    EXPECT_TRUE(runs(s, Effect::air_drag));
    s.settings.wind = Vector(0, 0, 0);
    EXPECT_TRUE(runs(s, Effect::air_drag)) << "air that stands still";
    s.settings.wind.reset();
    s.settings.require = {"air_drag"};
    EXPECT_FALSE(runs(s, Effect::air_drag)) << "there is no air";
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 0.1);
    EXPECT_EQ(simulation.ledger().calls[static_cast<std::size_t>(Stage::air_drag)], 0u);
}

TEST(Plan, TreesDivideSubstepsWhereTheyMay) {
    Scene s = box_on_the_ground();
    EXPECT_FALSE(runs(s, Effect::divided_trees)) << "there are no joints";
    add_body(s, box(0.1, 0.5, 0.1), {0, 3, 0});
    JointSpec joint;
    joint.body_a = 2, joint.anchor = {0, 3.5, 0};
    s.joints.push_back(joint);
    EXPECT_TRUE(runs(s, Effect::divided_trees));
    s.settings.tree_parts = 1;
    EXPECT_FALSE(runs(s, Effect::divided_trees));
    s.settings.tree_parts = 64, s.settings.joints = JointMethod::iterate;
    s.settings.require = {"divided_trees"};
    EXPECT_FALSE(runs(s, Effect::divided_trees)) << "no joint is solved as a tree";
    s.settings.joints = JointMethod::tree, s.settings.require.clear();
    for (const char* needed : {"joints", "joint_trees"}) {
        s.settings.forbid = {needed};
        EXPECT_FALSE(runs(s, Effect::divided_trees)) << needed;
    }
}

TEST(Plan, ParticlesTouchNothingWhereContactsAreForbidden) {
    Scene s = box_on_the_ground();
    EXPECT_FALSE(runs(s, Effect::particle_contacts));
    add_soft(s, rope({0.5, 0.1, 0}, {1, 0.1, 0}, 2));
    EXPECT_TRUE(runs(s, Effect::particle_contacts));
    s.settings.forbid = {"contacts"};
    EXPECT_FALSE(runs(s, Effect::particle_contacts));
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    EXPECT_LT(simulation.world().particles.position[0].y(), -4);
}

TEST(Plan, WhatNeedsNoWatchHasNone) {
    Scene s = box_on_the_ground();
    s.bodies.erase(s.bodies.begin());
    add_body(s, box(0.2, 0.2, 0.2), {0, 0.6, 0});
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 0.1);
    EXPECT_EQ(simulation.ledger().calls[static_cast<std::size_t>(Stage::still_ground)], 0u);
}

}  // namespace
}  // namespace plumb::test
