// SPDX-License-Identifier: MIT
/// Jointed bodies on sheets: joints, contacts and what holds the sheet together solved as one, so
/// that a joint is no wider open on a sheet than elsewhere.
#include "support/draw_settings.h"
#include "support/tray.h"

#include <iostream>
#include <numbers>

namespace plumb::test {
namespace {

class TiedOnSheets : public OnEveryCollider {
protected:
    std::uint32_t seed(std::uint32_t of_test) const {
        const std::string name = collider();
        return of_test + static_cast<std::uint32_t>(31 * name.size() + name[0]) +
               (std::get<1>(GetParam()) == Precision::single);
    }
};
INSTANTIATE_TEST_SUITE_P(, TiedOnSheets, every_collider(), where_name);

JointSpec& tie(Scene& s, JointKind kind, std::uint32_t a, std::uint32_t b, const Vector& anchor) {
    JointSpec joint;
    joint.kind = kind, joint.body_a = a, joint.body_b = b, joint.anchor = anchor;
    s.joints.push_back(joint);
    return s.joints.back();
}

/// A chain of two to seven bodies, each up to a hundred times as heavy as another, on ties of any
/// kind, that falls on a sheet.
Tray chain_over_tray(Scene empty, Random& random) {
    Tray t = empty_tray(std::move(empty), random);
    Scene& s = t.scene;
    s.materials[0].friction = random.number(0.2, 0.9);
    const std::uint32_t count = 2 + random.below(6);
    const double pitch = 0.6 * t.size / count, height = 0.8 * pitch;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector at((i + 0.5 - 0.5 * count) * pitch, height, 0);
        BodySpec& body = random.below(2) == 0
                             ? add_body(s, sphere(0.35 * pitch), at)
                             : add_body(s, box(0.38 * pitch, 0.2 * pitch, 0.3 * pitch), at);
        body.mass = t.cloth * std::pow(10, random.number(-1, 1));
        t.load += *body.mass;
        if (i == 0) continue;
        constexpr JointKind kKinds[] = {JointKind::ball,   JointKind::hinge, JointKind::universal,
                                        JointKind::slider, JointKind::fixed, JointKind::distance};
        JointSpec& joint =
            tie(s, kKinds[random.below(6)], i, i - 1, at - Vector(0.5 * pitch, 0, 0));
        if (joint.kind == JointKind::distance)
            joint.anchor = at - Vector(0.4 * pitch, 0, 0),
            joint.anchor_b = at - Vector(0.6 * pitch, 0, 0);
        if (joint.kind == JointKind::hinge)
            joint.axes[kTurnX].lower = -0.5, joint.axes[kTurnX].upper = 0.5;
        if (joint.kind == JointKind::slider)
            joint.axes[kAlongX].lower = -0.1 * pitch, joint.axes[kAlongX].upper = 0.1 * pitch;
    }
    return t;
}

/// Also while it falls on the sheet, to within a tenth of a link; and then to ten micrometres.
TEST_P(TiedOnSheets, ChainsOfAnyTiesHold) {
    Random random(seed(71));
    for (int draw = 0; draw < 6; ++draw) {
        Tray t = chain_over_tray(scene(), random);
        if (draw % 3 == 1) use_fine_steps(t.scene.settings);
        if (draw % 3 == 2) draw_steps(t.scene.settings, random, {0.002, 0.02, 6, 2, 8});
        Simulation simulation(t.scene, colliders(), collider());
        const double before = total_energy(simulation);
        double widest = 0, most = before;
        while (simulation.time() < 3) {
            ASSERT_TRUE(simulation.step().finite);
            widest = std::max(widest, widest_joint(simulation.world()));
            most = std::max(most, total_energy(simulation));
        }
        double later = 0;
        while (simulation.time() < 4) {
            simulation.step();
            later = std::max(later, widest_joint(simulation.world()));
        }
        const double pitch = 0.6 * t.size / double(t.scene.bodies.size());
        std::cout << draw << ": " << t.scene.bodies.size() << " bodies, " << t.load / t.cloth
                  << " times the sheet, " << t.scene.settings.dt << " s with "
                  << t.scene.settings.substeps << " substeps: open by " << widest / pitch
                  << " of a link, later by " << later << " m or rad\n";
        EXPECT_LT(most, before + 1e-3 * std::abs(before));
        EXPECT_LT(widest, 0.1 * pitch);
        EXPECT_LT(later, 1e-5);
    }
}

/// A block that falls on a sheet holds a boom out, with a load at its end. Nothing but the joint
/// and gravity acts on the load, so what the joint bears in a time T is its weight times T and what
/// its momentum changes by.
TEST_P(TiedOnSheets, BoomsBearTheirLoads) {
    Random random(seed(5));
    for (int draw = 0; draw < 6; ++draw) {
        Tray t = empty_tray(scene(), random);
        Scene& s = t.scene;
        draw_settings(s.settings, random, draw);
        // what is told of a joint is the mean of two substeps
        s.settings.substeps = std::min(s.settings.substeps, 2u);
        s.materials[0].friction = 0.6;
        const double a = 0.2 * t.size, reach = random.number(0.5, 1.2) * a;
        add_body(s, box(a, 0.2 * a, a), {0, 0.25 * a, 0}).mass = 5 * t.cloth;
        const double load = random.number(0.1, 1) * t.cloth;
        add_body(s, box(0.1 * a, 0.1 * a, 0.1 * a), {reach, 0.85 * a, 0}).mass = load;
        tie(s, JointKind::fixed, 1, 0, {0, 0.85 * a, 0});
        Simulation simulation(s, colliders(), collider());
        const World& world = simulation.world();
        run_until(simulation, 2);
        const Vector before = world.bodies.velocity[1];
        Vector borne = Vector::Zero();
        int steps = 0;
        for (; simulation.time() < 4; ++steps) {
            simulation.step();
            borne += simulation.joint_load(0).force;
        }
        borne /= steps;
        const Vector change = load * (world.bodies.velocity[1] - before),
                     expected = change / (steps * s.settings.dt) - load * s.settings.gravity;
        std::cout << draw << ": " << s.settings.dt << " s, " << s.settings.substeps << " substeps, "
                  << s.settings.position_iterations << " iterations: " << borne.transpose()
                  << " N, " << expected.transpose() << "\n";
        EXPECT_LT((borne - expected).norm(), 1e-3 * expected.norm());
    }
}

/// Motors turn what lies on a sheet as fast as they are asked to, and limits stop it.
TEST_P(TiedOnSheets, MotorsAndLimitsHold) {
    for (const bool stops : {false, true}) {
        Random random(seed(9));
        Tray t = empty_tray(scene(), random);
        Scene& s = t.scene;
        s.materials[0].friction = 0.6;
        const double a = 0.2 * t.size;
        add_body(s, box(a, 0.2 * a, a), {0, 0.2 * a, 0}).mass = 5 * t.cloth;
        add_body(s, box(0.8 * a, 0.1 * a, 0.2 * a), {0, 0.7 * a, 0}).mass = t.cloth;
        JointSpec& hinge = tie(s, JointKind::hinge, 1, 0, {0, 0.5 * a, 0});
        hinge.frame = Rotation(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitZ()));
        JointAxisSpec& axis = hinge.axes[kTurnX];
        axis.motor.mode = MotorMode::velocity, axis.motor.target = 0.5;
        axis.motor.greatest = 10 * t.cloth * a * a;
        if (stops) axis.upper = 0.7;
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 3);
        const double at = joint_position(simulation, 0, kTurnX);
        simulation.step();
        const double rate =
            (joint_position(simulation, 0, kTurnX) - at) / simulation.world().settings.dt;
        EXPECT_NEAR(rate, stops ? 0 : 0.5, 1e-3);
        if (stops) {
            EXPECT_NEAR(at, 0.7, 1e-3);
        }
        EXPECT_LT(widest_joint(simulation.world()), 1e-5);
    }
}

/// A kinematic hand lifts a box off the sheet at up to 3 m/s, or shakes it there at usual settings.
TEST_P(TiedOnSheets, HandsHoldWhatTheyLift) {
    Random random(seed(41));
    for (int draw = 0; draw < 6; ++draw) {
        Tray t = empty_tray(scene(), random);
        Scene& s = t.scene;
        const bool shakes = draw % 2 == 1;
        if (!shakes) draw_settings(s.settings, random, draw / 2);
        const double a = 0.1 * t.size, speed = random.number(0.5, 3);
        add_body(s, box(a, 0.5 * a, a), {0, 0.55 * a, 0}).mass = 2 * t.cloth;
        BodySpec& hand = add_body(s, sphere(0.1 * a), {0, 1.5 * a, 0}, Motion::kinematic);
        hand.mask = 0;
        tie(s, JointKind::ball, 0, 1, {0, 1.1 * a, 0});
        Simulation simulation(s, colliders(), collider());
        double widest = 0;
        while (simulation.time() < 1.5) {
            const double time = simulation.time();
            const Vector along =
                shakes ? Vector(std::cos(20 * time), 0, 0) : Vector(0, time > 0.7 ? 1 : 0, 0);
            simulation.set_velocity(1, speed * along, Vector::Zero());
            ASSERT_TRUE(simulation.step().finite);
            widest = std::max(widest, widest_joint(simulation.world()));
        }
        EXPECT_LT(widest, 1e-3 * t.size) << draw << ", at " << speed << " m/s, " << s.settings.dt
                                         << " s with " << s.settings.substeps << " substeps, "
                                         << s.settings.position_iterations << " iterations";
    }
}

/// Ropes that are too short at the start, or struts that are too long, let nothing fall through.
TEST_P(TiedOnSheets, RopesThatAreTooShortLetNothingFall) {
    Random random(seed(43));
    for (const double ratio : {0.85, 0.95, 1.02, 1.05}) {
        Tray t = empty_tray(scene(), random);
        Scene& s = t.scene;
        const double a = 0.08 * t.size;
        for (const double x : {-2.5 * a, 2.5 * a})
            add_body(s, box(a, 0.5 * a, a), {x, 0.8 * a, 0}).mass = t.cloth;
        LinkSpec& rope =
            add_link(s, on_body(0, {-1.5 * a, 0.8 * a, 0}), on_body(1, {1.5 * a, 0.8 * a, 0}));
        (ratio < 1 ? rope.longest : rope.shortest) = 3 * a * ratio;
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 2);
        const Bodies& b = simulation.world().bodies;
        const double apart = (b.position[0] + b.orientation[0] * Vector(a, 0, 0) - b.position[1] -
                              b.orientation[1] * Vector(-a, 0, 0))
                                 .norm();
        for (const int i : {0, 1}) EXPECT_GT(b.position[i].y(), -0.5 * t.size) << ratio;
        if (ratio < 1) {
            EXPECT_LT(apart, 3 * a * ratio + 1e-4);
        } else {
            EXPECT_GT(apart, 3 * a * ratio - 1e-4);
        }
    }
}

/// Nothing holds the sheet, and nothing pulls: what a chain loses, it gains.
TEST_P(TiedOnSheets, KeepMomentum) {
    Random random(seed(23));
    for (int draw = 0; draw < 3; ++draw) {
        Tray t = chain_over_tray(scene(), random);
        Scene& s = t.scene;
        s.attachments.clear();
        s.settings.gravity.setZero();
        draw_settings(s.settings, random, draw);
        double size = 0;
        for (BodySpec& body : s.bodies) {
            body.velocity = {random.number(-0.3, 0.3), -2, random.number(-0.3, 0.3)};
            size += *body.mass * body.velocity.norm();
        }
        Simulation simulation(s, colliders(), collider());
        const Vector linear = linear_momentum(simulation.world()),
                     angular = angular_momentum(simulation.world());
        double open = 0;
        while (simulation.time() < 2) {
            ASSERT_TRUE(simulation.step().finite);
            open = std::max(open, widest_joint(simulation.world()));
        }
        const double error = (linear_momentum(simulation.world()) - linear).norm() / size,
                     turning =
                         (angular_momentum(simulation.world()) - angular).norm() / (size * t.size);
        std::cout << draw << ": " << error << ", " << turning << "\n";
        const bool single = s.settings.precision == Precision::single;
        EXPECT_LT(error, single ? 1e-6 : 1e-10);
        // where a joint is open, its two forces are no longer in one line
        EXPECT_LT(turning, (single ? 1e-6 : 1e-10) + open / t.size);
    }
}

}  // namespace
}  // namespace plumb::test
