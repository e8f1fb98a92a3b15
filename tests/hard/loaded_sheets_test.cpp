// SPDX-License-Identifier: MIT
/// Bodies on sheets, their contacts and what holds the sheet together solved as one: it dents, and
/// all comes to rest.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/tray.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

namespace plumb::test {
namespace {

class LoadedSheets : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, LoadedSheets, every_collider(), where_name);

/// What falls on it: from a tenth of its mass to twenty times it.
Tray tray(Scene empty, Random& random) {
    Tray t = empty_tray(std::move(empty), random);
    const double radius = t.size * random.number(0.05, 0.2);
    t.is_round = random.below(2) == 0;
    // a ball rolls to and fro for long, so it falls into the middle
    const double aside = t.is_round ? 0 : random.number(-0.1, 0.1) * t.size;
    BodySpec& body =
        add_body(t.scene, t.is_round ? sphere(radius) : box(radius, 0.6 * radius, 0.8 * radius),
                 {aside, 1.5 * radius, -aside / 2});
    body.mass = t.load = t.cloth * std::pow(10, random.number(-1, 1.3));
    t.scene.materials[0].friction = random.number(0.2, 0.9);
    return t;
}

/// A heap of boxes that falls on it, each up to thirty times as heavy as another.
Tray heaped_tray(Scene empty, Random& random) {
    Tray t = empty_tray(std::move(empty), random);
    const std::uint32_t count = 2 + random.below(5);
    const double radius = t.size * random.number(0.06, 0.12);
    const bool is_stack = random.below(2) == 0;
    const double mass = t.cloth * std::pow(10, random.number(-1, 0.3));
    t.scene.materials[0].friction = random.number(0.2, 0.9);
    double height = 1.5 * radius;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double aside = is_stack ? 0.1 * radius : 1.2 * radius;
        const Vector at(random.number(-aside, aside), height, random.number(-aside, aside));
        BodySpec& body = add_body(t.scene, box(radius, 0.6 * radius, 0.8 * radius), at);
        body.mass = mass * std::pow(10, random.number(0, 1.5));
        t.load += *body.mass;
        height += 1.3 * radius;
    }
    return t;
}

double fastest_particle(const World& world) {
    double most = 0;
    for (const Vector& v : world.particles.velocity) most = std::max(most, v.norm());
    return most;
}

TEST_P(LoadedSheets, ComeToRestWithWhatLiesOnThem) {
    // each draws scenes of its own
    Random random(static_cast<std::uint32_t>(31 * collider().size() + collider()[0] +
                                             (GetParam() == Where(collider(), Precision::single))));
    for (int draw = 0; draw < 6; ++draw) {
        Tray t = tray(scene(), random);
        if (draw % 3 == 1) use_fine_steps(t.scene.settings);
        if (draw % 3 == 2) draw_steps(t.scene.settings, random, {0.002, 0.02, 6, 1, 8});
        Simulation simulation(t.scene, colliders(), collider());
        const World& world = simulation.world();
        run_until(simulation, 5);
        double body = 0, point = 0;
        while (simulation.time() < 6) {
            simulation.step();
            // what rolls on for long does not bob up and down
            body = std::max(
                body, t.is_round ? std::abs(world.bodies.velocity[0].y()) : fastest_point(world));
            point = std::max(point, fastest_particle(world));
        }
        std::cout << draw << ": " << t.load << " kg, body " << body << " m/s, points " << point
                  << " m/s at " << world.bodies.position[0].transpose() << "\n";
        EXPECT_LT(body, 5e-3);
        EXPECT_LT(point, t.is_round ? 0.02 : 5e-3);
        EXPECT_LT(world.bodies.position[0].y(), t.size);
        EXPECT_GT(world.bodies.position[0].y(), -t.size / 2) << "it has fallen through";
    }
}

/// The system is solved once where there are no iterations: what lies on a sheet comes to the
/// height at which more of them leave it.
TEST_P(LoadedSheets, NeedNoIterations) {
    Random random(19);
    for (int draw = 0; draw < 3; ++draw) {
        Tray t = tray(scene(), random);
        t.scene.settings.dt = random.number(0.004, 0.02);
        t.scene.settings.substeps = 1 + random.below(4);
        double height[2] = {0, 0};
        for (const std::uint32_t iterations : {0u, 5u}) {
            t.scene.settings.position_iterations = iterations;
            t.scene.settings.velocity_iterations = draw == 0 ? 0 : iterations;
            Simulation simulation(t.scene, colliders(), collider());
            run_until(simulation, 5);
            height[iterations > 0] = simulation.world().bodies.position[0].y();
        }
        std::cout << draw << ": at " << height[0] << " m, or " << height[1] << " m\n";
        EXPECT_NEAR(height[0], height[1], 1e-3 * t.size);
    }
}

/// Boxes lie on each other, too, in one system with the sheet; a heavy one swings for long. A point
/// under a corner that lies over an edge of the sheet may tremble, for the corner is held by
/// another triangle from step to step.
TEST_P(LoadedSheets, HeapsOnThemComeToRest) {
    Random random(static_cast<std::uint32_t>(57 * collider().size() + collider()[1] +
                                             (GetParam() == Where(collider(), Precision::single))));
    for (int draw = 0; draw < 6; ++draw) {
        Tray t = heaped_tray(scene(), random);
        if (draw % 3 == 1) use_fine_steps(t.scene.settings);
        if (draw % 3 == 2) draw_steps(t.scene.settings, random, {0.002, 0.02, 6, 1, 8});
        Simulation simulation(t.scene, colliders(), collider());
        const World& world = simulation.world();
        run_until(simulation, 12);
        for (std::uint32_t id = 0; id < t.scene.bodies.size(); ++id) {
            const Vector& at = world.bodies.position[*world.slots.find(id)];
            const bool has_fallen_off = std::max(std::abs(at.x()), std::abs(at.z())) > t.size / 2;
            EXPECT_TRUE(has_fallen_off || at.y() > -t.size / 2) << "it has fallen through";
            if (has_fallen_off) simulation.remove_body(id);
        }
        double body = 0, point = 0;
        while (simulation.time() < 13) {
            simulation.step();
            body = std::max(body, fastest_point(world));
            point = std::max(point, fastest_particle(world));
        }
        std::cout << draw << ": " << world.bodies.size() << " boxes, " << t.load / t.cloth
                  << " times the sheet, body " << body << " m/s, points " << point << " m/s\n";
        EXPECT_LT(body, 5e-3);
        EXPECT_LT(point, 0.05);
    }
}

/// What the contacts of a stack bear is the weight above them.
TEST_P(LoadedSheets, TellWhatStacksOnThemBear) {
    Random random(7);
    Tray t = empty_tray(scene(), random);
    t.scene.materials[0].friction = 0.6;
    const double radius = 0.15 * t.size;
    for (int i = 0; i < 3; ++i)
        add_body(t.scene, box(radius, 0.3 * radius, radius), {0, (0.31 + 0.61 * i) * radius, 0})
            .mass = t.cloth * (1 + 3 * i);
    Simulation simulation(t.scene, colliders(), collider());
    simulation.watch_contacts({});
    run_until(simulation, 12);
    simulation.step();
    Vector borne[3] = {Vector::Zero(), Vector::Zero(), Vector::Zero()};  // what holds each body up
    for (const BodyContact& c : simulation.contacts()) {
        ASSERT_EQ(c.body_b, c.body_a + 1);
        borne[c.body_b] -= c.force();
    }
    double above = 0;
    for (int i = 2; i > 0; --i) {
        above += simulation.world().bodies.mass[i];
        const Vector weight = -above * t.scene.settings.gravity;
        EXPECT_LT((borne[i] - weight).norm(), 1e-3 * weight.norm()) << i;
    }
}

}  // namespace
}  // namespace plumb::test
