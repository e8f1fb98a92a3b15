// SPDX-License-Identifier: MIT
/// A simulation that is restored goes on as the one that was saved, bit for bit; and bytes that are
/// no such state are refused.
#include "host/editing.h"
#include "math/fnv1a.h"
#include "scene/error.h"
#include "support/soft_scenes.h"

#include <cstring>
#include <utility>

namespace plumb::test {
namespace {

Scene noisy_heap() {
    Scene s = heap();
    add_machine(s);
    s.settings.substeps = 2;
    s.materials[0].restitution = 0.3;
    return s;
}

/// Saves after `before` steps, restores into one that was made apart and has made some steps of its
/// own, and compares both for `after` steps.
void expect_continuation(const Scene& scene, const std::string& collider, int before, int after) {
    Simulation one(scene, colliders(), collider), two(scene, colliders(), collider);
    for (int i = 0; i < before; ++i) one.step();
    for (int i = 0; i < 5; ++i) two.step();
    const std::string bytes = one.save();
    two.restore(bytes);
    EXPECT_EQ(hash_of(two), hash_of(one));
    EXPECT_EQ(two.steps(), one.steps());
    EXPECT_EQ(two.time(), one.time());
    EXPECT_EQ(two.save(), bytes);
    for (int i = 0; i < after; ++i) {
        one.step(), two.step();
        ASSERT_EQ(hash_of(two), hash_of(one)) << "step " << i;
    }
    EXPECT_EQ(two.save(), one.save());
    one.restore(bytes);
    for (int i = 0; i < after; ++i) one.step();
    EXPECT_EQ(hash_of(two), hash_of(one)) << "back in the same simulation";
}

class SavedStates : public testing::TestWithParam<std::string> {};

TEST_P(SavedStates, GoOnInTheMiddleOfAHeap) {
    expect_continuation(noisy_heap(), GetParam(), 37, 60);
}

INSTANTIATE_TEST_SUITE_P(All, SavedStates, testing::Values("reference", "ode", "bullet", "fcl"),
                         [](const auto& param_info) { return param_info.param; });

TEST(SavedState, GoesOnWhateverTheSettings) {
    for (const JointMethod method : {JointMethod::tree, JointMethod::iterate})
        for (const std::uint32_t islands : {0u, 400u})
            for (const char* required : {"", "shock_propagation"}) {
                Scene s = noisy_heap();
                s.settings.joints = method, s.settings.exact_islands = islands;
                s.settings.substeps = 3;
                if (*required) s.settings.require = {required};
                expect_continuation(s, "ode", 30, 30);
            }
    Scene paper = noisy_heap();
    apply_paper_preset(paper.settings);
    expect_continuation(paper, "ode", 30, 30);
}

/// An arm of two motors, one of which a coupling ties to a wheel, beside a spring and a limit.
Scene robot() {
    Scene s;
    s.settings.substeps = 4;
    add_ground(s);
    for (int i = 0; i < 4; ++i) add_body(s, box(0.2, 0.05, 0.1), {-1 + 0.5 * i, 1, 0});
    for (std::uint32_t i = 0; i < 4; ++i) {
        JointSpec joint;
        joint.kind = JointKind::hinge;
        joint.body_a = 1 + i, joint.body_b = i == 0 || i == 3 ? kNoIndex : i;
        joint.anchor = {-1.25 + 0.5 * i, 1, 0};
        joint.frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
        JointAxisSpec& axis = joint.axes[kTurnX];
        axis.friction = 0.1;
        if (i == 0) axis.motor.mode = MotorMode::velocity, axis.motor.target = 2;
        if (i == 1) axis.motor.mode = MotorMode::position, axis.motor.keys = {{0, 0}, {0.5, 0.4}};
        if (i == 2) axis.stiffness = 3, axis.damping = 0.1, axis.lower = -0.3, axis.upper = 0.3;
        s.joints.push_back(joint);
    }
    s.couplings.push_back({"", 0, 3, kTurnX, kTurnX, 0.5, 0.4});
    return s;
}

TEST(SavedState, OfARobotWithDrivesAndCouplingsGoesOn) {
    for (const JointMethod method : {JointMethod::auto_, JointMethod::tree, JointMethod::iterate}) {
        Scene s = robot();
        s.settings.joints = method;
        expect_continuation(s, "reference", 45, 100);
    }
}

TEST(SavedState, HasTheTargetsOfMotorsAndForces) {
    Simulation one(robot(), colliders(), "reference"), two(robot(), colliders(), "reference");
    const std::string start = one.save();
    one.set_motor_target(1, kTurnX, -0.3);
    one.set_force(4, {0, 5, 0}, {0.1, 0, 0});
    for (int i = 0; i < 20; ++i) one.step();
    two.restore(one.save());
    for (int i = 0; i < 50; ++i) one.step(), two.step();
    EXPECT_EQ(hash_of(two), hash_of(one));
    Simulation fresh(robot(), colliders(), "reference");
    one.restore(start);
    for (int i = 0; i < 50; ++i) one.step(), fresh.step();
    EXPECT_EQ(hash_of(fresh), hash_of(one)) << "with the keys of its motor again";
}

/// What breaks is let go, and its bodies may touch; back before that they may not.
TEST(SavedState, KnowsOfBrokenJoints) {
    for (const JointMethod method : {JointMethod::tree, JointMethod::iterate}) {
        Scene s = noisy_heap();
        s.settings.joints = method;
        s.joints[2].breaking_force = 1;
        s.joints[1].breaking_force = 1e4;
        expect_continuation(s, "ode", 40, 60);
        Simulation one(s, colliders(), "ode"), two(s, colliders(), "ode");
        const std::string whole = one.save();
        for (int i = 0; i < 40; ++i) one.step();
        ASSERT_TRUE(one.is_broken(2));
        two.restore(one.save());
        EXPECT_TRUE(two.is_broken(2));
        two.restore(whole);
        EXPECT_FALSE(two.is_broken(2));
        for (int i = 0; i < 40; ++i) two.step();
        EXPECT_EQ(hash_of(two), hash_of(one));
    }
}

/// A sheet that hangs by two corners, one on a swinging box, and falls on a ball.
Scene sheet() {
    Scene s;
    s.settings.substeps = 3;
    add_ground(s);
    add_body(s, sphere(0.3), {0.5, 0.3, 0.5});
    add_body(s, box(0.1, 0.1, 0.1), {0, 0.9, 0});
    DeformableSpec cloth;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j) cloth.points.push_back({0.125 * i, 0.8, 0.125 * j});
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t j = 0; j < 8; ++j) {
            const std::uint32_t at = 9 * i + j;
            cloth.triangles.push_back({at, at + 1, at + 10});
            cloth.triangles.push_back({at, at + 10, at + 9});
        }
    s.deformables.push_back(cloth);
    AttachmentSpec corner;
    corner.deformable = 0, corner.points = {0}, corner.body = 2;
    s.attachments.push_back(corner);
    LinkSpec rope;
    rope.a.deformable = 0, rope.a.point = 8;
    rope.b.position = {0, 1.3, 1};
    rope.longest = 0.5;
    s.links.push_back(rope);
    return s;
}

TEST(SavedState, OfClothGoesOn) {
    Scene s = sheet();
    expect_continuation(s, "reference", 40, 80);
    s.settings.exact_deformables = 1000;
    expect_continuation(s, "reference", 40, 80);
    // and with two boxes on a hinge that lie on it
    s.attachments[0].points = {0, 72, 80};
    s.attachments[0].body = kNoIndex;
    add_body(s, box(0.1, 0.05, 0.1), {0.4, 0.87, 0.5});
    add_body(s, box(0.1, 0.05, 0.1), {0.62, 0.87, 0.5});
    JointSpec hinge;
    hinge.kind = JointKind::hinge, hinge.anchor = {0.51, 0.87, 0.5};
    hinge.body_a = 4, hinge.body_b = 3;
    hinge.axes[kTurnX].upper = 0.2;
    s.joints.push_back(hinge);
    expect_continuation(s, "reference", 40, 80);
}

/// Also back to when less was torn.
TEST(SavedState, KnowsWhatIsTorn) {
    Scene exact = shot_through_a_sheet();
    exact.settings.exact_deformables = 10000;
    for (const Scene& s : {shot_through_a_sheet(), exact})
        expect_continuation(s, "reference", 4, 40);
    Simulation simulation(shot_through_a_sheet(), colliders(), "reference");
    const std::string whole = simulation.save();
    run_for(simulation, 0.3);
    EXPECT_FALSE(simulation.world().deformables[0].torn.empty());
    simulation.restore(whole);
    const Deformable& d = simulation.world().deformables[0];
    EXPECT_TRUE(d.torn.empty());
    EXPECT_EQ(d.spec.triangles, d.whole.triangles);
}

TEST(SavedState, GoesOnOnAnyNumberOfThreadsAndLanes) {
    Scene s = noisy_heap();
    Simulation one(s, colliders(), "ode");
    for (int i = 0; i < 30; ++i) one.step();
    s.settings.threads = 3, s.settings.lanes = 4;
    Simulation two(s, colliders(), "ode");
    two.restore(one.save());
    for (int i = 0; i < 40; ++i) one.step(), two.step();
    EXPECT_EQ(hash_of(two), hash_of(one));
}

TEST(SavedState, GoesOnAfterTheSameEdits) {
    const auto edited = [](Simulation& simulation) {
        simulation.remove_body(5);
        const std::uint32_t ball = simulation.add_body(body_of(2, {1.5, 4, 0.3}));
        simulation.add_body(body_of(1, {1.1, 5, 0.3}));
        JointSpec rod;
        rod.kind = JointKind::distance;
        rod.body_a = ball, rod.anchor = {1.5, 4, 0.3}, rod.anchor_b = {2.5, 5, 0.3};
        simulation.add_joint(rod);
    };
    Simulation one(heap(), colliders(), "ode"), two(heap(), colliders(), "ode");
    for (int i = 0; i < 20; ++i) one.step();
    edited(one), edited(two);
    for (int i = 0; i < 20; ++i) one.step();
    two.restore(one.save());
    for (int i = 0; i < 60; ++i) {
        one.step(), two.step();
        ASSERT_EQ(hash_of(two), hash_of(one)) << "step " << i;
    }
    EXPECT_EQ(two.add_body(body_of(1, {9, 9, 9})), one.add_body(body_of(1, {9, 9, 9})));
    one.remove_body(7);
    expect_refusal<std::invalid_argument>([&] { two.restore(one.save()); },
                                          "of one that was edited otherwise");
}

TEST(SavedState, KnowsWhatTouchesForTheEventsToCome) {
    Simulation one(noisy_heap(), colliders(), "ode"), two(noisy_heap(), colliders(), "ode");
    one.watch_contacts(), two.watch_contacts();
    for (int i = 0; i < 50; ++i) one.step();
    two.restore(one.save());
    EXPECT_TRUE(two.contacts().empty());
    for (int i = 0; i < 20; ++i) {
        one.step(), two.step();
        ASSERT_EQ(two.contact_events().size(), one.contact_events().size());
        ASSERT_EQ(two.contacts().size(), one.contacts().size());
        for (std::size_t k = 0; k < one.contacts().size(); ++k)
            ASSERT_EQ(two.contacts()[k].impulse(), one.contacts()[k].impulse());
    }
}

/// States that someone made up, with hashes that fit: whatever they say, the steps after them come
/// to an end. Each word in turn is that of a body that does not exist.
void make_up_states(Simulation& simulation) {
    constexpr std::size_t kHash = 12 + 4 + 16, kHeader = kHash + 8;
    const std::string good = simulation.save();
    int restored = 0;
    for (const std::uint32_t value : {7u, 0xffffffffu, 0x7ffffff0u})
        for (std::size_t at = kHeader; at + 4 <= good.size(); at += 4) {
            std::string bad = good;
            std::memcpy(bad.data() + at, &value, 4);
            Fnv1a hash;
            hash.add(bad.data() + kHeader, bad.size() - kHeader);
            const std::uint64_t sum = hash.value();
            std::memcpy(bad.data() + kHash, &sum, 8);
            try {
                simulation.restore(bad);
                ++restored;
                for (int i = 0; i < 3; ++i) simulation.step();
            } catch (const std::exception& e) {
                EXPECT_STRNE(e.what(), "");
            }
        }
    EXPECT_GT(restored, 100);
    simulation.restore(good);
    EXPECT_EQ(simulation.save(), good) << "a good one goes before all of that";
}

TEST(SavedState, ThatIsMadeUpEndsNoProgram) {
    for (const bool sleep : {false, true}) {
        Scene s;
        if (sleep) s.settings.sleep_speed = 0.01;
        add_ground(s);
        for (int i = 0; i < 3; ++i) add_body(s, box(0.1, 0.1, 0.1), {0, 0.1 + 0.2 * i, 0});
        // it strikes what may sleep two steps after the state is saved
        add_body(s, sphere(0.1), {-5, 0.3, 0}).velocity = {5.2, 4.4, 0};
        Simulation simulation(s, colliders(), "ode");
        for (int i = 0; i < 91; ++i) simulation.step();
        EXPECT_EQ(simulation.world().bodies.motion[1], sleep ? Motion::asleep : Motion::dynamic);
        make_up_states(simulation);
    }
}

TEST(SavedState, IsRefusedWithASentenceWhereItIsNoneOfThisScene) {
    const auto refused = [](Simulation& simulation, const std::string& bytes,
                            const std::string& words) {
        const std::uint64_t hash = hash_of(simulation);
        expect_refusal<std::invalid_argument>([&] { simulation.restore(bytes); }, words);
        EXPECT_EQ(hash_of(simulation), hash);
    };
    Simulation simulation(noisy_heap(), colliders(), "ode");
    for (int i = 0; i < 10; ++i) simulation.step();
    const std::string good = simulation.save();
    simulation.step();
    refused(simulation, "", "no state");
    refused(simulation, "something else altogether", "no state");
    refused(simulation, good.substr(0, 20), "cut short");
    refused(simulation, good.substr(0, good.size() - 1), "cut short");
    refused(simulation, good + "x", "bytes follow");
    std::string bad = good;
    bad[good.size() / 2] ^= 1;
    refused(simulation, bad, "damaged");
    bad = good, bad[12] = 77;
    refused(simulation, bad, "version 77");
    Scene other = noisy_heap();
    other.bodies[3].mass = 7;
    Simulation stranger(other, colliders(), "ode");
    refused(stranger, good, "another scene");
    other = noisy_heap(), other.settings.substeps = 5;
    Simulation finer(other, colliders(), "ode");
    refused(finer, good, "another scene");
}

TEST(MovedSimulation, GoesOn) {
    static_assert(std::is_nothrow_move_constructible_v<Simulation>);
    static_assert(std::is_nothrow_move_assignable_v<Simulation>);
    Simulation still(noisy_heap(), colliders(), "ode"), first(noisy_heap(), colliders(), "ode");
    for (int i = 0; i < 10; ++i) still.step(), first.step();
    Simulation second = std::move(first);
    for (int i = 0; i < 10; ++i) still.step(), second.step();
    first = std::move(second);
    for (int i = 0; i < 10; ++i) still.step(), first.step();
    EXPECT_EQ(hash_of(first), hash_of(still));
}

}  // namespace
}  // namespace plumb::test
