// SPDX-License-Identifier: MIT
/// Bodies that come, go and are moved by hand while a simulation runs, on every collider.
#include "host/editing.h"

#include <cstring>
#include <tuple>

namespace plumb::test {
namespace {

/// How far a body falls from rest in n steps: the sum of the steps' velocities [m].
double fall(int n) { return kGravity * kStep * kStep * n * (n + 1) / 2; }

class EditedBodies : public testing::TestWithParam<std::string> {
protected:
    /// Two cubes of 0.4 m on one another: bodies 1 and 2, on the ground, 0.
    static Scene pair_of_cubes() {
        Scene s;
        add_ground(s);
        add_body(s, box(0.2, 0.2, 0.2), {0, 0.2, 0});
        add_body(s, box(0.2, 0.2, 0.2), {0, 0.6, 0});
        return s;
    }
    Simulation running(const Scene& scene) const { return {scene, colliders(), GetParam()}; }
};

TEST_P(EditedBodies, WhatLosesItsSupportFallsAtOnce) {
    Simulation s = running(pair_of_cubes());
    make_steps(s, 100);
    const double height = s.body_state(2).placement.position.y();
    const double speed = s.body_state(2).velocity.y();
    EXPECT_NEAR(height, 0.6, 1e-3);
    s.remove_body(1);
    EXPECT_FALSE(s.has_body(1));
    make_steps(s, 20);
    EXPECT_NEAR(s.body_state(2).placement.position.y(), height + 20 * kStep * speed - fall(20),
                1e-9);
    make_steps(s, 100);
    EXPECT_NEAR(s.body_state(2).placement.position.y(), 0.2, 1e-3);
}

TEST_P(EditedBodies, WhatIsAddedFallsAndRestsOnWhatIsThere) {
    Simulation s = running(pair_of_cubes());
    make_steps(s, 50);
    BodySpec cube = body_of(1, {0, 2, 0});
    cube.velocity = {0, 0, 0};
    const std::uint32_t third = s.add_body(cube);
    EXPECT_EQ(third, 3u);
    make_steps(s, 20);
    EXPECT_NEAR(s.body_state(third).placement.position.y(), 2 - fall(20), 1e-9);
    make_steps(s, 150);
    EXPECT_NEAR(s.body_state(third).placement.position.y(), 1.0, 2e-3);
}

TEST_P(EditedBodies, ANewBodyInAnOldPlaceHasNoPast) {
    Scene scene = pair_of_cubes();
    scene.apart.push_back({1, 2});
    scene.bodies[2].placement.position = {3, 0.2, 0};
    Simulation s = running(scene);
    make_steps(s, 50);
    s.remove_body(1);
    const std::uint32_t id = s.add_body(body_of(1, {3, 0.8, 0}));
    EXPECT_EQ(id, 3u);
    EXPECT_EQ(s.slot_of(id), 1u);
    make_steps(s, 100);
    EXPECT_NEAR(s.body_state(id).placement.position.y(), 0.6, 1e-3)
        << "the pair was kept apart, the new one is not";
    const auto hit = s.cast_ray({3, 5, 0}, -Vector::UnitY());
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->body, id);
    const Contact c = s.closest(id, 2);
    EXPECT_EQ(c.a, 2u);
    EXPECT_EQ(c.b, id);
    EXPECT_NEAR(c.normal.y, -1, 1e-3) << "out of b, above, towards a";
    EXPECT_NEAR(c.gap, 0, 1e-3);
    EXPECT_NEAR(c.point_a.y, 0.4, 1e-3);
}

TEST_P(EditedBodies, AnotherShapeWhereOneStoodIsLookedAtAnew) {
    Scene scene = pair_of_cubes();
    scene.bodies.pop_back();
    Simulation s = running(scene);
    const std::uint32_t ball = s.add_geometry(sphere(0.2));
    make_steps(s, 50);
    ASSERT_GE(s.step().contacts, 4u);
    BodySpec spec = body_of(ball, Vector::Zero());
    spec.placement = s.body_state(1).placement;
    s.remove_body(1);
    EXPECT_EQ(s.slot_of(s.add_body(spec)), 1u);
    EXPECT_EQ(s.step().contacts, 1u) << "those of the cube were kept";
}

TEST_P(EditedBodies, WhatIsAddedIsThereForQueriesAtOnce) {
    Simulation s = running(pair_of_cubes());
    make_steps(s, 1);
    const std::uint32_t id = s.add_body(body_of(1, {3, 0.2, 0}));
    EXPECT_NEAR(s.closest(0, id).gap, 0, 1e-12);
    const auto hit = s.cast_ray({3, 5, 0}, -Vector::UnitY());
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->body, id);
    s.remove_body(2);
    EXPECT_EQ(s.cast_ray({0, 5, 0}, -Vector::UnitY())->body, 1u);
}

TEST_P(EditedBodies, AFixedBodyThatIsPutElsewhereTakesItsLoadNoMore) {
    Scene scene;
    add_body(scene, box(1, 0.5, 1), {0, -0.5, 0}, Motion::fixed);
    add_body(scene, box(0.2, 0.2, 0.2), {0, 0.2, 0});
    Simulation s = running(scene);
    make_steps(s, 100);
    const BodyState before = s.body_state(1);
    s.set_placement(0, {{0, -1.5, 0}, Rotation::Identity()});
    make_steps(s, 20);
    EXPECT_NEAR(s.body_state(1).placement.position.y(),
                before.placement.position.y() + 20 * kStep * before.velocity.y() - fall(20), 1e-9);
    make_steps(s, 150);
    EXPECT_NEAR(s.body_state(1).placement.position.y(), -0.8, 1e-3);
}

TEST_P(EditedBodies, WhatIsMovedByHandStaysWhereItIsPut) {
    Simulation s = running(pair_of_cubes());
    make_steps(s, 100);
    s.remove_body(2);
    s.set_placement(1, {{0.05, 0.2, 0}, Rotation::Identity()});
    s.set_velocity(1, Vector::Zero(), Vector::Zero());
    make_steps(s, 200);
    EXPECT_NEAR(s.body_state(1).placement.position.x(), 0.05, 1e-5)
        << "friction does not draw it back to where it stuck";
}

INSTANTIATE_TEST_SUITE_P(All, EditedBodies, testing::Values("reference", "ode", "bullet", "fcl"),
                         [](const auto& param_info) { return param_info.param; });

/// Contacts stand in columns, and by pairs: what stays, stays together.
TEST(EditedBody, TakesItsOwnContactsAlongAlone) {
    const Scene scene = heap();
    Simulation s(scene, colliders(), "ode");
    make_steps(s, 150);
    for (const std::uint32_t body :
         {17u, static_cast<std::uint32_t>(scene.bodies.size()) - 1, 0u}) {
        const ContactTable before = s.world().contacts;
        s.remove_body(body);
        const ContactTable& now = s.world().contacts;
        ContactTable listed;
        std::size_t stays = 0, pairs = 0;
        for (std::size_t i = 0; i < before.found.size(); ++i) {
            const Contact& c = before.found[i];
            if (c.a == body || c.b == body) continue;
            ASSERT_LT(stays, now.found.size());
            EXPECT_EQ(std::memcmp(&now.found[stays], &c, sizeof c), 0);
            EXPECT_EQ(now.memory[stays].normal_impulse, before.memory[i].normal_impulse);
            EXPECT_EQ(now.kept.rides[stays].point_b.x, before.kept.rides[i].point_b.x);
            listed.add_to_pairs(c, static_cast<std::uint32_t>(stays++));
        }
        EXPECT_LT(stays, before.found.size());
        EXPECT_EQ(now.found.size(), stays);
        EXPECT_EQ(now.memory.size(), stays);
        EXPECT_EQ(now.kept.rides.size(), stays);
        ASSERT_EQ(now.pairs.size(), listed.pairs.size());
        for (std::size_t i = 0; i < listed.pairs.size(); ++i) {
            const ContactPair &is = now.pairs[i], &should = listed.pairs[i];
            EXPECT_EQ(std::tie(is.a, is.b, is.first, is.count),
                      std::tie(should.a, should.b, should.first, should.count));
        }
        for (std::size_t i = 0; i < before.kept.pairs.size(); ++i) {
            const KeptPair& pair = before.kept.pairs[i];
            if (pair.a == body || pair.b == body) continue;
            ASSERT_LT(pairs, now.kept.pairs.size());
            EXPECT_EQ(std::tie(now.kept.pairs[pairs].a, now.kept.pairs[pairs].b),
                      std::tie(pair.a, pair.b));
            EXPECT_EQ(now.kept.poses[pairs++].offset, before.kept.poses[i].offset);
        }
        EXPECT_EQ(now.kept.pairs.size(), pairs);
        EXPECT_EQ(now.kept.poses.size(), pairs);
    }
}

TEST(EditedBody, APlacementIsThatOfTheGeometry) {
    Scene scene;
    Geometry two;  // its centre of mass lies aside
    two.kind = ShapeKind::compound;
    two.parts = {{box(0.1, 0.1, 0.1), {{1, 0, 0}, Rotation::Identity()}},
                 {sphere(0.2), {{0, 0.5, 0}, Rotation::Identity()}}};
    add_body(scene, two, {0, 5, 0});
    Simulation s(scene, colliders(), "reference");
    const Placement wanted{{1, 2, 3}, Rotation(Eigen::AngleAxisd(1, Vector(1, 2, 2) / 3))};
    s.set_placement(0, wanted);
    const Placement is = s.body_state(0).placement;
    EXPECT_LT((is.position - wanted.position).norm(), 1e-14);
    EXPECT_LT(is.rotation.angularDistance(wanted.rotation), 1e-7);
    scene.bodies[0].placement = wanted;
    const Simulation built(scene, colliders(), "reference");
    EXPECT_LT((built.world().bodies.position[0] - s.world().bodies.position[0]).norm(), 1e-14);
}

TEST(EditedBody, AForceIsThatUntilItIsReplaced) {
    Scene scene;
    scene.settings.gravity.setZero();
    add_body(scene, sphere(0.5), {0, 0, 0}).mass = 2;
    Simulation s(scene, colliders(), "reference");
    s.set_force(0, {6, 0, 0}, Vector::Zero());
    make_steps(s, 100);
    EXPECT_NEAR(s.body_state(0).velocity.x(), 3, 1e-12);
    s.set_force(0, Vector::Zero(), Vector::Zero());
    make_steps(s, 100);
    EXPECT_NEAR(s.body_state(0).velocity.x(), 3, 1e-12);
}

TEST(EditedBody, EffectsComeWithWhatCallsForThem) {
    Scene scene;
    add_ground(scene);
    Simulation s(scene, colliders(), "reference");
    make_steps(s, 3);
    for (const Decision& d : s.plan().decisions) EXPECT_FALSE(d.runs) << d.name;
    Material bouncy;
    bouncy.restitution = 0.8, bouncy.friction = 0;
    const std::uint32_t ball = s.add_geometry(sphere(0.25)), material = s.add_material(bouncy);
    BodySpec spec = body_of(ball, {0, 1.25, 0});
    spec.material = material;
    const std::uint32_t id = s.add_body(spec);
    EXPECT_TRUE(s.plan().runs(Effect::contacts));
    EXPECT_TRUE(s.plan().runs(Effect::restitution));
    EXPECT_FALSE(s.plan().runs(Effect::gyroscopic));
    double fastest = 0, after = 0;
    for (int i = 0; i < 100; ++i) {
        s.step();
        const double v = s.body_state(id).velocity.y();
        fastest = std::max(fastest, -v), after = std::max(after, v);
    }
    EXPECT_NEAR(after / fastest, 0.8, 0.01);

    const std::uint32_t brick = s.add_body(body_of(s.add_geometry(box(0.1, 0.2, 0.3)), {5, 9, 0}));
    EXPECT_TRUE(s.plan().runs(Effect::gyroscopic));
    JointSpec joint;
    joint.body_a = brick;
    joint.anchor = {5, 9.2, 0};
    s.add_joint(joint);
    EXPECT_TRUE(s.plan().runs(Effect::joints));
    EXPECT_TRUE(s.plan().runs(Effect::joint_trees));
    s.remove_body(brick);
    EXPECT_FALSE(s.plan().runs(Effect::gyroscopic));
    EXPECT_FALSE(s.plan().runs(Effect::joints));
    s.remove_body(id);
    EXPECT_FALSE(s.plan().runs(Effect::contacts));
    make_steps(s, 3);
    EXPECT_EQ(s.step().contacts, 0u);
    EXPECT_TRUE(s.world().contacts.found.empty());
}

TEST(EditedBody, RemarksOfTheReaderStayAmongTheWarnings) {
    Scene scene = heap();
    scene.remarks = {"a remark"};
    scene.settings.forbid = {"friction"};
    Simulation s(scene, colliders(), "reference");
    const auto before = s.plan().warnings;
    ASSERT_EQ(before.size(), 2u);
    s.remove_body(3);
    EXPECT_EQ(s.plan().warnings, before);
}

TEST(EditedBody, AFountainKeepsItsTablesSmall) {
    Scene scene;
    add_ground(scene);
    add_geometry(scene, sphere(0.1));
    Simulation s(scene, colliders(), "ode");
    std::vector<std::uint32_t> drops;
    for (int i = 0; i < 200; ++i) {
        BodySpec drop = body_of(1, {0, 1, 0});
        drop.velocity = {0.1 * (i % 7 - 3), 3, 0.1 * (i % 5 - 2)};
        drops.push_back(s.add_body(drop));
        if (drops.size() > 30) s.remove_body(drops[drops.size() - 31]);
        ASSERT_TRUE(s.step().finite);
        ASSERT_LE(s.world().bodies.size(), 32u);
    }
    EXPECT_EQ(drops.back(), 200u);
    EXPECT_FALSE(s.has_body(drops[169]));
    EXPECT_TRUE(s.has_body(drops[170]));
    Frame frame;
    s.capture(frame);
    ASSERT_EQ(frame.ids.size(), frame.bodies.size());
    EXPECT_EQ(frame.ids[s.slot_of(drops.back())], drops.back());
}

}  // namespace
}  // namespace plumb::test
