// SPDX-License-Identifier: MIT
/// What joints hold and what touches is one system: structures on lids, platforms, flaps and tables
/// stand, motors and friction hold what lies on them, and a gripper what it grips. What joints
/// cannot hold ends in no explosion.
#include "measure/measure.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace plumb::test {
namespace {

/// Turns a frame's x axis into z.
const Rotation kAboutZ(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector::UnitY()));
/// And into y.
const Rotation kAlongUp(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitZ()));

void add_tower(Scene& s, const Vector& foot, int cubes, double half, double mass) {
    for (int i = 0; i < cubes; ++i)
        add_body(s, box(half, half, half), foot + Vector(0, (2 * i + 1) * half, 0)).mass = mass;
}

/// A lid of 1 m, hinged to the world at one edge, that lies on a block at the other.
Scene lid(Scene s, int cubes) {
    add_ground(s);
    add_body(s, box(0.05, 0.25, 0.3), {0.4, 0.25, 0}, Motion::fixed);
    add_body(s, box(0.5, 0.02, 0.3), {0, 0.52, 0}).mass = 5;
    add_joint(s, JointKind::hinge, 2, kNoIndex, {-0.5, 0.5, 0}).frame = kAboutZ;
    add_tower(s, {0, 0.54, 0}, cubes, 0.1, 2);
    return s;
}

/// A platform of 10 kg on a vertical slider, which a motor keeps at rest.
Scene platform(Scene s, double greatest = 1000) {
    add_ground(s);
    add_body(s, box(0.5, 0.05, 0.5), {0, 1, 0}).mass = 10;
    JointSpec& slider = add_joint(s, JointKind::slider, 1, kNoIndex, {0, 1, 0});
    slider.frame = kAlongUp;
    slider.axes[kAlongX].motor.mode = MotorMode::velocity;
    slider.axes[kAlongX].motor.greatest = greatest;
    add_tower(s, {0.1, 1.05, 0.1}, 3, 0.15, 8);
    return s;
}

/// A flap that friction holds level, 1.1 times what it has to bear.
Scene flap(Scene s) {
    add_ground(s);
    add_body(s, box(0.3, 0.02, 0.2), {0.3, 1, 0}).mass = 2;
    JointSpec& hinge = add_joint(s, JointKind::hinge, 1, kNoIndex, {0, 1, 0});
    hinge.frame = kAboutZ;
    hinge.axes[kTurnX].friction = 1.1 * 9.81 * (2 * 0.3 + 3 * 0.4);
    add_tower(s, {0.4, 1.02, 0}, 1, 0.08, 3);
    return s;
}

/// Two jaws of 1 kg that hang on sliders and press a box of 2 kg between them with a share of the
/// force that friction needs to hold it.
Scene gripper(Scene s, double share = 1.2) {
    s.materials[0].friction = 0.6;
    add_ground(s);
    add_body(s, box(0.1, 0.1, 0.1), {0, 1, 0}).mass = 2;
    for (const int side : {-1, 1}) {
        add_body(s, box(0.02, 0.08, 0.08), {0.12 * side, 1, 0}).mass = 1;
        JointSpec& slider =
            add_joint(s, JointKind::slider, static_cast<std::uint32_t>(s.bodies.size()) - 1,
                      kNoIndex, {0.12 * side, 1, 0});
        JointMotor& motor = slider.axes[kAlongX].motor;
        motor.mode = MotorMode::velocity, motor.target = -side;
        motor.greatest = share * 2 * 9.81 / (2 * 0.6);
    }
    return s;
}

/// A table that joints hold together: a top and four legs, each fixed to it.
Scene table(Scene s) {
    add_ground(s);
    add_body(s, box(0.5, 0.03, 0.5), {0, 0.73, 0}).mass = 8;
    for (const int x : {-1, 1})
        for (const int z : {-1, 1}) {
            add_body(s, box(0.03, 0.35, 0.03), {0.4 * x, 0.35, 0.4 * z}).mass = 1;
            add_joint(s, JointKind::fixed, static_cast<std::uint32_t>(s.bodies.size()) - 1, 1,
                      {0.4 * x, 0.7, 0.4 * z});
        }
    add_tower(s, {0.1, 0.76, 0}, 4, 0.1, 2);
    return s;
}

/// The same under a slab of a thousand times its weight.
Scene loaded_table(Scene s) {
    s = table(std::move(s));
    s.bodies.resize(s.bodies.size() - 4);
    add_body(s, box(0.4, 0.1, 0.4), {0, 0.86, 0}).mass = 12000;
    return s;
}

struct Named {
    const char* name;
    Scene scene;
};

std::vector<Named> still_scenes(const Scene& s) {
    return {{"lid", lid(s, 3)},
            {"lid and one", lid(s, 1)},
            {"platform", platform(s)},
            {"platform without bounds", platform(s, std::numeric_limits<double>::infinity())},
            {"flap", flap(s)},
            {"gripper", gripper(s)},
            {"table", table(s)},
            {"loaded table", loaded_table(s)}};
}

class JointedIslands : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, JointedIslands, every_collider(), where_name);

TEST_P(JointedIslands, StandStill) {
    for (const Named& named : still_scenes(scene())) {
        SCOPED_TRACE(named.name);
        Simulation simulation(named.scene, colliders(), collider());
        expect_still(motions_between(simulation, 3, 10));
        EXPECT_LT(widest_joint(simulation.world()), 1e-5);
    }
}

TEST_P(JointedIslands, StandStillAtDrawnSettings) {
    Random random(7);
    for (const Named& named : still_scenes(scene())) {
        Scene s = named.scene;
        s.settings.dt = random.number(0.002, 0.02);
        s.settings.substeps = 1 + static_cast<std::uint32_t>(random.below(10));
        s.settings.velocity_iterations = 1 + static_cast<std::uint32_t>(random.below(20));
        s.settings.position_iterations = 1 + static_cast<std::uint32_t>(random.below(20));
        SCOPED_TRACE(testing::Message() << named.name << ", dt " << s.settings.dt << ", "
                                        << s.settings.substeps << " substeps");
        Simulation simulation(s, colliders(), collider());
        expect_still(motions_between(simulation, 3, 6));
        EXPECT_LT(widest_joint(simulation.world()), 1e-5);
    }
}

TEST_P(JointedIslands, BearWhatLiesOnThem) {
    Simulation simulation(platform(scene()), colliders(), collider());
    run_for(simulation, 1);
    const double weight = (10 + 3 * 8) * 9.81;
    EXPECT_NEAR(simulation.joint_load(0).force.y(), weight, 1e-6 * weight);
}

/// A grip that is too weak lets the box slide out, as fast as its weight less friction makes it.
TEST_P(JointedIslands, AWeakGripSlidesByTheLaw) {
    for (const double share : {0.5, 0.9}) {
        Simulation simulation(gripper(scene(), share), colliders(), collider());
        const auto speed = [&] { return -simulation.world().bodies.velocity[1].y(); };
        run_for(simulation, 0.1);
        const double before = speed();
        run_for(simulation, 0.15);
        const double fall = 9.81 * 0.15;
        EXPECT_NEAR(speed() - before, (1 - share) * fall, 2e-3 * fall) << share;
    }
}

/// Bodies in threes on joints of all kinds, drawn together in free space until they lie on each
/// other.
Scene free_heap(Scene s, Random& random) {
    s.settings.gravity.setZero();
    constexpr JointKind kinds[] = {
        JointKind::ball,  JointKind::hinge,    JointKind::universal,  JointKind::slider,
        JointKind::fixed, JointKind::distance, JointKind::cone_twist, JointKind::cylindrical};
    std::uint32_t n = 0;
    for (int i = 0; i < 6; ++i) {
        const Vector middle(0, 0.5 * (i % 3 - 1), 0.5 * (i / 3 - 0.5));
        for (int k = 0; k < 3; ++k, ++n) {
            BodySpec& body = add_body(s, box(0.12, 0.1, 0.08), middle + Vector(0.25 * k, 0, 0));
            body.mass = random.number(1, 5);
            body.velocity = -0.4 * middle;
            if (k == 0) continue;
            const Vector anchor = middle + Vector(0.25 * k - 0.125, 0, 0);
            JointSpec& joint = add_joint(s, kinds[random.below(8)], n, n - 1, anchor);
            if (joint.kind == JointKind::distance)
                joint.anchor = anchor + Vector(0.05, 0, 0), joint.anchor_b = anchor;
        }
    }
    return s;
}

TEST_P(JointedIslands, KeepMomentumAndGainNothing) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        Random random(seed);
        Scene s = free_heap(scene(), random);
        s.settings.dt = random.number(0.002, 0.02);
        s.settings.substeps = 1 + random.below(8);
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", dt " << s.settings.dt << ", "
                                        << s.settings.substeps << " substeps");
        Simulation simulation(s, colliders(), collider());
        const World& world = simulation.world();
        const Vector linear = linear_momentum(world), angular = angular_momentum(world);
        double scale = 0, turning = 0;
        for (std::size_t i = 0; i < world.bodies.size(); ++i) {
            const Vector p = world.bodies.mass[i] * world.bodies.velocity[i];
            scale += p.norm(), turning += world.bodies.position[i].cross(p).norm();
        }
        const double energy = kinetic_energy(world);
        for (int i = 0; i < 400; ++i) {
            simulation.step();
            ASSERT_LT(kinetic_energy(world), 1.01 * energy) << i;
        }
        const double bound = s.settings.precision == Precision::single ? 1e-5 : 1e-10;
        EXPECT_LT((linear_momentum(world) - linear).norm(), bound * scale);
        EXPECT_LT((angular_momentum(world) - angular).norm(), bound * (scale + turning));
    }
}

/// A box on the ground that hangs by a ball at one corner, and by a hinge at another whose limits
/// it cannot reach.
Scene contradiction(Scene s) {
    add_ground(s);
    add_body(s, box(0.4, 0.2, 0.4), {0, 0.2, 0}).mass = 8;
    add_joint(s, JointKind::ball, 1, kNoIndex, {-0.4, 0.2, 0});
    JointSpec& hinge = add_joint(s, JointKind::hinge, 1, kNoIndex, {0.4, 0.2, 0});
    hinge.frame = kAboutZ;
    hinge.axes[kTurnX].lower = 0.1, hinge.axes[kTurnX].upper = 0.5;
    return s;
}

/// A light ram that a motor of 100 tons' weight presses on a block before a wall.
Scene ram(Scene s) {
    add_ground(s);
    add_body(s, box(0.2, 0.5, 0.5), {0.72, 0.5, 0}, Motion::fixed);
    add_body(s, box(0.2, 0.2, 0.2), {0.31, 0.2, 0}).mass = 5;
    add_body(s, box(0.1, 0.1, 0.1), {0, 0.2, 0}).mass = 0.1;
    JointMotor& motor =
        add_joint(s, JointKind::slider, 3, kNoIndex, {0, 0.2, 0}).axes[kAlongX].motor;
    motor.mode = MotorMode::velocity, motor.target = 1, motor.greatest = 1e6;
    return s;
}

/// Four capsules on balls in a ring on the ground.
Scene ring(Scene s) {
    add_ground(s);
    for (int i = 0; i < 4; ++i) {
        const Rotation turn(Eigen::AngleAxisd(std::numbers::pi / 2 * i, Vector::UnitY()));
        BodySpec& link = add_body(s, capsule(0.03, 0.17), turn * Vector(0, 0, 0.2));
        link.placement.position.y() = 0.03;
        link.placement.rotation = turn * kAlongUp;
        link.mass = 0.5;
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Rotation turn(Eigen::AngleAxisd(std::numbers::pi / 2 * i, Vector::UnitY()));
        Vector at = turn * Vector(0.2, 0, 0.2);
        at.y() = 0.03;
        add_joint(s, JointKind::ball, 1 + i, 1 + (i + 1) % 4, at);
    }
    return s;
}

TEST_P(JointedIslands, WhatCannotBeHeldStaysBounded) {
    for (const Named& named : {Named{"contradiction", contradiction(scene())},
                               Named{"ram", ram(scene())}, Named{"ring", ring(scene())}})
        for (const double dt : {0.002, 0.01, 0.02}) {
            if (named.scene.geometries.back().kind == ShapeKind::capsule &&
                collider() == "reference")
                continue;
            Scene s = named.scene;
            s.settings.dt = dt;
            SCOPED_TRACE(testing::Message() << named.name << ", dt " << dt);
            Simulation simulation(s, colliders(), collider());
            double fastest = 0;
            for (double end = 4; simulation.time() < end;) {
                ASSERT_TRUE(simulation.step().finite);
                fastest = std::max(fastest, fastest_point(simulation.world()));
            }
            EXPECT_LT(fastest, 5) << "no faster than what is asked for, some times over";
        }
}

TEST_P(JointedIslands, HaveTheSameBitsOnAnyThreads) {
    std::uint64_t hashes[2];
    for (const std::uint32_t threads : {1u, 2u}) {
        Scene s = table(scene());
        s.settings.threads = threads;
        const Scene other = lid(scene(), 2);
        const auto shift = static_cast<std::uint32_t>(s.bodies.size());
        for (BodySpec body : other.bodies) {
            if (body.motion == Motion::fixed && body.geometry == 0) continue;
            body.geometry = add_geometry(s, other.geometries[body.geometry]);
            body.placement.position.x() += 5;
            s.bodies.push_back(body);
        }
        JointSpec hinge = other.joints[0];
        hinge.body_a += shift - 1, hinge.anchor.x() += 5;
        s.joints.push_back(hinge);
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 0.5);
        hashes[threads - 1] = state_hash(simulation.world());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace plumb::test
