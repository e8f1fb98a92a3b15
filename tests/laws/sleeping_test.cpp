// SPDX-License-Identifier: MIT
/// What sleeps stays where it is and costs nothing, and is disturbed as it would be awake.
#include "host/editing.h"
#include "scene/error.h"
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"
#include "world/sleep.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

constexpr double kSlow = 0.01;  ///< below which bodies fall asleep [m/s]

std::uint32_t asleep(const World& world) {
    return static_cast<std::uint32_t>(
        std::count(world.bodies.motion.begin(), world.bodies.motion.end(), Motion::asleep));
}

class Sleep : public OnEveryCollider {
protected:
    Scene sleepy_scene() const {
        Scene s = scene();
        s.settings.sleep_speed = kSlow;
        return s;
    }
    Simulation running(const Scene& s) const { return {s, colliders(), collider()}; }

    /// The same scene twice: where bodies may sleep, and where they may not.
    struct Twins {
        Simulation sleepy, wakeful;
    };
    Twins twins(Scene s) const {
        Simulation sleepy = running(s);
        s.settings.sleep_speed = 0;
        return {std::move(sleepy), running(s)};
    }

    /// Boxes on each other on the ground.
    Scene stack(int count) const {
        Scene s = sleepy_scene();
        add_ground(s);
        for (int i = 0; i < count; ++i) add_body(s, box(0.2, 0.2, 0.2), {0, 0.2 + 0.4 * i, 0});
        return s;
    }
};
INSTANTIATE_TEST_SUITE_P(, Sleep, every_collider(), where_name);

TEST_P(Sleep, WhatRestsFallsAsleepWhereItIs) {
    Scene s = heap();
    s.settings.precision = scene().settings.precision;
    s.settings.sleep_speed = kSlow;
    s.materials[0].rolling_friction = s.materials[0].spinning_friction = 0.01;
    Simulation simulation = running(s);
    const World& world = simulation.world();
    run_for(simulation, 12);
    ASSERT_EQ(asleep(world), 36u);
    EXPECT_EQ(simulation.step().asleep, 36u);
    EXPECT_TRUE(world.contacts.found.empty());
    EXPECT_EQ(kinetic_energy(world), 0);
    const double potential = potential_energy(world);
    EXPECT_GT(potential, 0) << "what sleeps has its weight";
    const std::vector<Vector> places = world.bodies.position;
    run_for(simulation, 3);
    EXPECT_EQ(world.bodies.position, places);
    EXPECT_EQ(potential_energy(world), potential);
    const std::vector<double> depths = penetrations(world);
    EXPECT_FALSE(depths.empty()) << "and its contacts";
    EXPECT_LT(*std::max_element(depths.begin(), depths.end()), 1e-3);
}

/// In free space what nothing has touched is exactly at rest, so that being awake makes no
/// difference: not in a bit.
TEST_P(Sleep, WhatIsHitMovesAsIfItHadBeenAwake) {
    Random random(31);
    for (int draw = 0; draw < 12; ++draw) {
        Scene s = sleepy_scene();
        s.settings.gravity.setZero();
        s.settings.sleep_time = 0.1;
        s.settings.substeps = 1 + random.below(draw % 2 == 0 ? 1 : 6);
        s.settings.velocity_iterations = 2 + random.below(8);
        s.settings.position_iterations = 2 + random.below(8);
        s.materials[0].restitution = draw % 3 == 0 ? 0 : random.number(0, 1);
        const bool balls = draw % 2 == 0;
        const std::uint32_t count = 2 + random.below(6);
        for (std::uint32_t i = 0; i < count; ++i)
            add_body(s, balls ? sphere(0.125) : box(0.125, 0.125, 0.125), {0.25 * i, 0, 0});
        add_body(s, sphere(0.125), {-2, random.number(-0.05, 0.05), 0}).velocity = {4, 0, 0};
        SCOPED_TRACE("draw " + std::to_string(draw));
        Twins t = twins(s);
        bool slept = false;
        while (t.sleepy.time() < 1.5) {
            t.sleepy.step(), t.wakeful.step();
            slept |= asleep(t.sleepy.world()) == count;
            const Bodies &x = t.sleepy.world().bodies, &y = t.wakeful.world().bodies;
            ASSERT_TRUE(x.position == y.position && x.velocity == y.velocity &&
                        x.angular_velocity == y.angular_velocity)
                << "at " << t.sleepy.time() << " s";
        }
        EXPECT_TRUE(slept);
    }
}

/// A ball that strikes a stack: how all move does not depend on whether the stack slept.
TEST_P(Sleep, AStackIsStruckAsIfItHadBeenAwake) {
    for (const bool fine : {false, true}) {
        Scene s = stack(3);
        if (fine) use_fine_steps(s.settings);
        BodySpec& ball = add_body(s, sphere(0.15), {-20, 0.9, 0});
        ball.velocity = {15, 6.54, 0};  // it comes down again where the stack is
        Twins t = twins(s);
        run_for(t.sleepy, 1.2), run_for(t.wakeful, 1.2);
        EXPECT_EQ(asleep(t.sleepy.world()), 3u);
        run_for(t.sleepy, 0.35), run_for(t.wakeful, 0.35);
        EXPECT_EQ(asleep(t.sleepy.world()), 0u);
        const Bodies &x = t.sleepy.world().bodies, &y = t.wakeful.world().bodies;
        EXPECT_GT(x.velocity[3].x(), 0.5) << "struck";
        for (std::size_t i = 1; i < x.size(); ++i)
            EXPECT_LT((x.velocity[i] - y.velocity[i]).norm(), 1e-2) << "body " << i;
    }
}

TEST_P(Sleep, DominoesFallOneAfterAnother) {
    constexpr int kCount = 12;
    Scene s = sleepy_scene();
    add_ground(s);
    for (int i = 0; i < kCount; ++i) add_body(s, box(0.02, 0.2, 0.1), {0.2 * i, 0.2, 0});
    Twins t = twins(s);
    run_for(t.sleepy, 1), run_for(t.wakeful, 1);
    EXPECT_EQ(asleep(t.sleepy.world()), std::uint32_t(kCount));
    for (Simulation* simulation : {&t.sleepy, &t.wakeful})
        simulation->set_velocity(1, {0.3, 0, 0}, {0, 0, -2.5});
    const auto fallen_after = [](Simulation& simulation) {
        while (simulation.time() < 10) {
            simulation.step();
            if (simulation.world().bodies.position[kCount].y() < 0.15) break;
        }
        return simulation.time();
    };
    EXPECT_NEAR(fallen_after(t.sleepy), fallen_after(t.wakeful), 0.05);
    EXPECT_LT(t.sleepy.time(), 10);
    run_for(t.sleepy, 4);
    EXPECT_EQ(asleep(t.sleepy.world()), std::uint32_t(kCount)) << "and sleep again";
}

TEST_P(Sleep, WhatLosesItsSupportFalls) {
    Scene s = stack(2);
    add_body(s, box(0.3, 0.3, 0.3), {3, 0.3, 0}, Motion::fixed);
    add_body(s, box(0.1, 0.1, 0.1), {3, 0.7, 0});
    add_body(s, box(0.3, 0.3, 0.3), {6, 0.3, 0}, Motion::kinematic);
    add_body(s, box(0.1, 0.1, 0.1), {6, 0.7, 0});
    Simulation simulation = running(s);
    const Bodies& b = simulation.world().bodies;
    run_for(simulation, 1);
    EXPECT_EQ(asleep(simulation.world()), 4u);
    simulation.remove_body(1);  // the lower box of the stack
    simulation.set_placement(3, {{3, 0.3, 5}, Rotation::Identity()});
    simulation.set_velocity(5, {0, -0.25, 0}, {0, 0, 0});
    run_for(simulation, 1);
    EXPECT_NEAR(b.position[2].y(), 0.2, 1e-3);
    EXPECT_NEAR(b.position[4].y(), 0.1, 1e-3);
    EXPECT_NEAR(b.position[6].y(), 0.45, 1e-3) << "rides down";
    EXPECT_EQ(b.motion[6], Motion::dynamic) << "on what is moved along nothing sleeps";
    simulation.set_velocity(5, Vector::Zero(), Vector::Zero());
    run_for(simulation, 1);
    EXPECT_EQ(asleep(simulation.world()), 3u);
}

TEST_P(Sleep, WhateverIsAskedOfItWakesIt) {
    const auto after = [&](auto&& ask) {
        Scene s = stack(2);
        add_joint(s, JointKind::hinge, 2, 1, {0.2, 0.4, 0});
        s.joints.back().axes[kTurnX].motor.mode = MotorMode::position;
        Simulation simulation = running(s);
        run_for(simulation, 1.5);
        EXPECT_EQ(asleep(simulation.world()), 2u);
        ask(simulation);
        simulation.step();
        return 2 - asleep(simulation.world());
    };
    EXPECT_EQ(after([](Simulation&) {}), 0u);
    EXPECT_EQ(after([](Simulation& s) { s.set_velocity(2, {0, 1, 0}, {0, 0, 0}); }), 2u);
    EXPECT_EQ(after([](Simulation& s) { s.set_force(1, {500, 0, 0}, {0, 0, 0}); }), 2u);
    EXPECT_EQ(after([](Simulation& s) { s.set_motor_target(0, kTurnX, 0.5); }), 2u);
    EXPECT_EQ(after([](Simulation& s) { s.remove_joint(0); }), 2u);
    EXPECT_EQ(after([](Simulation& s) {
                  s.set_placement(2, {{0, 1.5, 0}, Rotation::Identity()});
              }),
              2u);
    EXPECT_EQ(after([](Simulation& s) {
                  BodySpec body = body_of(1, {0, 1.01, 0});
                  s.add_body(body);
              }),
              2u);
    EXPECT_EQ(after([](Simulation& s) {
                  JointSpec joint;
                  joint.body_a = 2;
                  joint.anchor = {0, 3, 0};
                  s.add_joint(joint);
              }),
              2u);
}

/// Whatever the step: also where it is asked which bodies rest.
TEST_P(Sleep, NoEditIsSwallowed) {
    Scene s = stack(1);
    add_body(s, box(0.3, 0.1, 0.3), {3, 0.1, 0});
    add_body(s, box(0.1, 0.1, 0.1), {3, 0.3, 0});
    add_body(s, box(0.1, 0.1, 0.1), {6, 3, 0});
    add_joint(s, JointKind::fixed, 4, kNoIndex, {6, 3, 0});
    for (int steps = 40; steps <= 62; ++steps) {
        Simulation simulation = running(s);
        make_steps(simulation, steps);
        const std::vector<Vector> before = simulation.world().bodies.position;
        simulation.set_force(1, {2000, 0, 0}, Vector::Zero());
        simulation.set_placement(3, {{3, 2, 0}, Rotation::Identity()});
        simulation.remove_joint(0);
        make_steps(simulation, 30);
        const std::vector<Vector>& after = simulation.world().bodies.position;
        SCOPED_TRACE(steps);
        EXPECT_GT(after[1].x() - before[1].x(), 0.01);
        EXPECT_LT(after[3].y(), 1.6);
        EXPECT_LT(after[4].y(), 2.6);
    }
}

/// What begins to move does not rest, however slowly it begins.
TEST_P(Sleep, WhatBeginsToMoveGoesOn) {
    Scene light = sleepy_scene();
    light.settings.gravity = {0, -0.015, 0};
    add_body(light, sphere(0.1), {0, 2, 0});
    Scene pushed = sleepy_scene();
    pushed.settings.gravity.setZero();
    BodySpec& heavy = add_body(pushed, box(0.2, 0.2, 0.2), {0, 2, 0});
    heavy.mass = 100, heavy.force = {0, -1, 0};
    Scene dropped = sleepy_scene();
    dropped.settings.sleep_time = 0, dropped.settings.dt = 1e-3;
    add_body(dropped, sphere(0.1), {0, 2, 0});
    for (Scene* s : {&light, &pushed, &dropped}) {
        Simulation simulation = running(*s);
        const double a = s == &light ? 0.015 : s == &pushed ? 0.01 : kGravity;
        run_for(simulation, s == &dropped ? 0.4 : 4);
        const double t = simulation.time();
        EXPECT_NEAR(simulation.world().bodies.position[0].y(), 2 - 0.5 * a * t * t, 0.02 * a * t);
    }
}

/// A door on which a box rests goes at some time, on which none of the box's own depends.
TEST_P(Sleep, WhatLiesOnWhatIsMovedAlongFallsWithIt) {
    for (const double dt : {0.001, 0.002, 0.01})
        for (int k = 0; k < 12; ++k) {
            Scene s = sleepy_scene();
            s.settings.dt = dt, s.settings.sleep_speed = 0.03;
            BodySpec& door = add_body(s, box(0.3, 0.1, 0.3), {0, 0, 0}, Motion::kinematic);
            const double opens = 0.9 + 0.7 * dt * k;
            door.script.keyframes = {{0, {{0, 0, 0}, Rotation::Identity()}},
                                     {opens, {{0, 0, 0}, Rotation::Identity()}},
                                     {opens + dt, {{9, 0, 0}, Rotation::Identity()}}};
            add_body(s, box(0.1, 0.1, 0.1), {0, 0.2, 0});
            Simulation simulation = running(s);
            run_for(simulation, 1.3);
            EXPECT_LT(simulation.world().bodies.position[1].y(), 0) << dt << " s, " << k;
        }
}

/// A lamp that hangs from the world on two rods, and a lid on a stop: joints, limits and friction.
TEST_P(Sleep, JointsHoldWhatSleeps) {
    Scene s = sleepy_scene();
    add_body(s, box(0.05, 0.3, 0.05), {0, -0.3, 0});
    add_body(s, box(0.05, 0.3, 0.05), {0, -0.9, 0});
    add_joint(s, JointKind::ball, 0, kNoIndex, {0, 0, 0});
    add_joint(s, JointKind::ball, 1, 0, {0, -0.6, 0});
    for (JointSpec& joint : s.joints)
        for (const int axis : {kTurnX, kTurnY, kTurnZ}) joint.axes[axis].damping = 8;
    add_body(s, box(0.3, 0.02, 0.2), {2.3, 0, 0});
    add_joint(s, JointKind::hinge, 2, kNoIndex, {2, 0, 0}).axes[kTurnX].lower = -0.2;
    s.joints.back().axes[kTurnX].upper = 0.2;
    s.joints.back().frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
    s.bodies[1].velocity = {0.5, 0, 0};
    Simulation simulation = running(s);
    const World& world = simulation.world();
    run_for(simulation, 30);
    ASSERT_EQ(asleep(world), 3u);
    EXPECT_LT(widest_joint(world), 1e-5);
    const std::vector<Vector> places = world.bodies.position;
    run_for(simulation, 2);
    EXPECT_EQ(world.bodies.position, places);
    simulation.set_velocity(1, {1, 0, 0}, {0, 0, 0});
    run_for(simulation, 0.3);
    EXPECT_EQ(asleep(world), 1u) << "the lid alone";
    EXPECT_GT((world.bodies.position[1] - places[1]).norm(), 0.05);
    EXPECT_LT(widest_joint(world), 1e-5);
    simulation.remove_joint(0);
    run_for(simulation, 0.5);
    EXPECT_LT(world.bodies.position[0].y(), -1);
}

TEST_P(Sleep, ContactsAndEventsGoOn) {
    Simulation simulation = running(stack(3));
    simulation.watch_contacts();
    run_for(simulation, 1.5);
    ASSERT_EQ(asleep(simulation.world()), 3u);
    double on_ground = 0;
    for (const BodyContact& c : simulation.contacts()) {
        EXPECT_TRUE(c.touches);
        if (c.body_a == 0) on_ground += c.normal_force;
    }
    const double weight = 3 * simulation.world().bodies.mass[1] * kGravity;
    EXPECT_NEAR(on_ground, weight, 1e-3 * weight);
    const std::size_t contacts = simulation.contacts().size();
    for (int i = 0; i < 50; ++i) {
        simulation.step();
        ASSERT_EQ(simulation.contacts().size(), contacts);
        for (const ContactEvent& event : simulation.contact_events())
            ASSERT_EQ(event.kind, ContactEvent::Kind::hit);
    }
    simulation.set_velocity(3, {0, 3, 0}, {0, 0, 0});
    run_for(simulation, 0.1);
    EXPECT_LT(simulation.contacts().size(), contacts);
}

/// A slow press leaves nothing asleep under it, nor does what shakes for ever.
TEST_P(Sleep, WhatIsMovedAlongKeepsAwakeWhatItTouches) {
    Scene s = stack(2);
    s.settings.sleep_time = 0.2;
    BodySpec& lid = add_body(s, box(0.3, 0.1, 0.3), {0, 1.0, 0}, Motion::kinematic);
    lid.script.keyframes = {{0, {{0, 1.0, 0}, Rotation::Identity()}},
                            {5, {{0, 0.9, 0}, Rotation::Identity()}},
                            {10, {{0, 1.0, 0}, Rotation::Identity()}}};
    Simulation simulation = running(s);
    run_for(simulation, 1);
    EXPECT_EQ(asleep(simulation.world()), 2u) << "not yet touched";
    while (simulation.time() < 4.9) {
        simulation.step();
        const World& world = simulation.world();
        const double gap = world.bodies.position[3].y() - 0.1 - 0.8;
        if (gap < -1e-4) {
            EXPECT_EQ(asleep(world), 0u) << "at " << simulation.time() << " s";
        }
    }
}

TEST(Sleeping, IsTheSameOnAnyNumberOfThreads) {
    Scene s = heap();
    s.settings.sleep_speed = 0.05, s.settings.sleep_time = 0.2;
    s.materials[0].rolling_friction = s.materials[0].spinning_friction = 0.01;
    add_machine(s);
    std::vector<std::uint64_t> hashes;
    for (const std::uint32_t threads : {1u, 2u, 4u}) {
        s.settings.threads = threads;
        Simulation simulation(s, colliders(), "ode");
        run_for(simulation, 3);
        EXPECT_GT(asleep(simulation.world()), 0u);
        simulation.add_body(body_of(1, {1.2, 2.5, 0.3}));
        run_for(simulation, 2);
        hashes.push_back(hash_of(simulation));
    }
    EXPECT_EQ(hashes[1], hashes[0]);
    EXPECT_EQ(hashes[2], hashes[0]);
}

TEST(Sleeping, GoesOnFromASavedState) {
    Scene s = heap();
    s.settings.sleep_speed = 0.05, s.settings.sleep_time = 0.2;
    s.materials[0].rolling_friction = s.materials[0].spinning_friction = 0.01;
    add_machine(s);
    add_body(s, sphere(0.2), {1.2, 60, 0.3});  // falls on the heap after 3.5 s
    for (const int before : {150, 330, 349, 360, 500}) {
        Simulation one(s, colliders(), "ode"), two(s, colliders(), "ode");
        make_steps(one, before), make_steps(two, 5);
        if (before == 330) {
            EXPECT_GT(asleep(one.world()), 20u);
        }
        const std::string bytes = one.save();
        two.restore(bytes);
        EXPECT_EQ(two.save(), bytes);
        for (int i = 0; i < 120; ++i) {
            one.step(), two.step();
            ASSERT_EQ(hash_of(two), hash_of(one)) << before << " and " << i << " steps";
        }
        EXPECT_EQ(two.save(), one.save());
    }
}

/// A chain that sleeps is a tree all the same when it is struck: after a state is restored, and
/// after an edit elsewhere.
TEST(Sleeping, JointsAreSolvedAsTheyWereBefore) {
    Scene s;
    s.settings.sleep_speed = kSlow;
    for (std::uint32_t i = 0; i < 8; ++i) {
        add_body(s, box(0.05, 0.1, 0.05), {0, -0.1 - 0.2 * i, 0});
        add_joint(s, JointKind::ball, i, i == 0 ? kNoIndex : i - 1, {0, -0.2 * i, 0});
    }
    add_body(s, sphere(0.1), {-10, -1.0, 0}).velocity = {5, 9.81, 0};  // comes by after 2 s
    Simulation one(s, colliders(), "ode"), two(s, colliders(), "ode"), three(s, colliders(), "ode");
    s.settings.sleep_speed = 0;
    Simulation wakeful(s, colliders(), "ode");
    make_steps(one, 150), make_steps(three, 150), make_steps(wakeful, 150);
    ASSERT_EQ(asleep(one.world()), 8u);
    two.restore(one.save());
    three.add_material({});
    double widest = 0, widest_awake = 0;
    for (int i = 0; i < 150; ++i) {
        one.step(), two.step(), three.step(), wakeful.step();
        ASSERT_EQ(hash_of(two), hash_of(one)) << "step " << i;
        ASSERT_EQ(hash_of(three), hash_of(one)) << "step " << i;
        widest = std::max(widest, widest_joint(one.world()));
        widest_awake = std::max(widest_awake, widest_joint(wakeful.world()));
    }
    EXPECT_TRUE(two.plan().runs(Effect::joint_trees));
    EXPECT_GT((one.world().bodies.position[7] - Vector(0, -1.5, 0)).norm(), 0.05) << "struck";
    EXPECT_LT(widest, 1.1 * widest_awake + 1e-6);
}

/// Edits that are refused wake nothing, and those far away change nothing of what sleeps.
TEST(Sleeping, EditsElsewhereChangeNothing) {
    Scene s;
    s.settings.sleep_speed = kSlow;
    add_ground(s);
    for (std::uint32_t i = 0; i < 2; ++i) {
        add_body(s, box(0.1, 0.1, 0.1), {0.5 * i, 1, 0});
        JointSpec& joint = add_joint(s, JointKind::slider, 1 + i, i == 0 ? kNoIndex : 1, {0, 1, 0});
        joint.axes[kAlongX].stiffness = 1000, joint.axes[kAlongX].damping = 100;
    }
    add_body(s, box(0.1, 0.1, 0.1), {50, 1, 0});
    add_joint(s, JointKind::ball, 3, kNoIndex, {50, 1, 0});
    Simulation simulation(s, colliders(), "ode");
    const auto crowd = [&] { return simulation.world().joints.joints[0].crowd; };
    const std::uint32_t before = crowd();
    EXPECT_EQ(before, 2u);
    run_for(simulation, 3);
    ASSERT_EQ(asleep(simulation.world()), 3u);
    const std::string state = simulation.save();
    EXPECT_THROW(simulation.set_motor_target(0, kAlongX, 1), std::invalid_argument);
    JointSpec wrong;
    wrong.body_a = wrong.body_b = 1;
    EXPECT_THROW(simulation.add_joint(wrong), SceneError);
    EXPECT_EQ(simulation.save(), state);
    simulation.remove_joint(2);
    EXPECT_EQ(crowd(), before);
    EXPECT_EQ(asleep(simulation.world()), 2u);
}

/// Particles wake what they meet, and what a string holds stays awake.
TEST(Sleeping, WhatDeformsKeepsAwakeWhatItTouches) {
    Scene s;
    s.settings.sleep_speed = kSlow;
    add_ground(s);
    add_body(s, box(0.2, 0.2, 0.2), {0, 0.2, 0});
    add_body(s, box(0.2, 0.2, 0.2), {3, 0.2, 0});
    DeformableSpec rope;
    rope.kind = DeformableKind::rope;
    rope.points = {{-0.1, 6, 0}, {0, 6, 0}, {0.1, 6, 0}};
    rope.segments = {{0, 1}, {1, 2}};
    rope.thickness = 0.02;
    s.deformables.push_back(rope);
    Simulation simulation(s, colliders(), "ode");
    run_for(simulation, 1);
    EXPECT_EQ(asleep(simulation.world()), 2u);
    run_for(simulation, 1);
    EXPECT_EQ(asleep(simulation.world()), 1u) << "the rope lies on the other";
    EXPECT_EQ(simulation.world().bodies.motion[1], Motion::dynamic);
}

}  // namespace
}  // namespace plumb::test
