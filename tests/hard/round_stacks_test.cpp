// SPDX-License-Identifier: MIT
/// Pipes, capsules and balls in pyramids without rolling friction: they stand where statics lets
/// them, and roll apart where it does not.
#include "support/random.h"
#include "support/scenes.h"

#include <cmath>
#include <numbers>

namespace plumb::test {
namespace {

class RoundStacks : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, RoundStacks, every_collider(), where_name);

/// Lying one beside another, with `rows` of them at the bottom.
void add_pipes(Scene& s, const Geometry& pipe, double radius, int rows) {
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i)
            add_body(s, pipe, {(2 * i + row) * radius, (1 + std::sqrt(3) * row) * radius, 0})
                .placement.rotation = Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitX());
}

/// Four-sided, each ball in the hollow of four.
void add_balls(Scene& s, double radius, int rows) {
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i)
            for (int k = 0; k < rows - row; ++k)
                add_body(s, sphere(radius),
                         radius * Vector(2 * i + row, 1 + std::sqrt(2) * row, 2 * k + row));
}

/// Three on the ground and one in their hollow.
void add_four_balls(Scene& s, double radius) {
    const double out = 2 / std::sqrt(3), up = std::sqrt(4 - out * out);
    for (int i = 0; i < 3; ++i) {
        const double angle = i * 2 * std::numbers::pi / 3;
        add_body(s, sphere(radius),
                 radius * Vector(out * std::cos(angle), 1, out * std::sin(angle)));
    }
    add_body(s, sphere(radius), {0, (1 + up) * radius, 0});
}

void add_pyramid(Scene& s, const std::string& of, double radius, int rows) {
    add_ground(s);
    if (of == "four balls")
        add_four_balls(s, radius);
    else if (of == "balls")
        add_balls(s, radius, rows);
    else
        add_pipes(s, of == "pipes" ? cylinder(radius, 0.5) : capsule(radius, 0.5), radius, rows);
}

bool has(const std::string& collider, const std::string& what) {
    return what != "pipes" || collider != "reference";
}

void draw_settings(Settings& settings, Random& random) {
    settings.dt = random.number(0.002, 0.02);
    settings.substeps = 1 + random.below(6);
    settings.velocity_iterations = settings.position_iterations = 3 + random.below(10);
}

/// A lower one is in balance where the force at its upper contact points to where it stands: that
/// force leans from the normal by half the angle θ of the normal from the vertical, so the friction
/// between them is at least tan θ/2 (and less on the ground).
TEST_P(RoundStacks, StandAndFallAsStaticsSays) {
    const double of_pipes = std::tan(std::numbers::pi / 12),
                 of_balls = std::tan(std::asin(1 / std::sqrt(3)) / 2);
    Random random(3);
    for (const auto& [what, least] : {std::pair<std::string, double>{"pipes", of_pipes},
                                      {"capsules", of_pipes},
                                      {"four balls", of_balls}})
        for (const double share : {0.97, 1.02, 1.3, 2.0}) {
            if (!has(collider(), what)) continue;
            SCOPED_TRACE(what + " at " + std::to_string(share));
            Scene s = scene();
            if (share > 1.2) draw_settings(s.settings, random);
            s.materials[0].friction = share * least;
            add_pyramid(s, what, 0.2, 2);
            Simulation simulation(s, colliders(), collider());
            const Motions motions = motions_between(simulation, 0, 3);
            if (share < 1) {
                EXPECT_GT(motions.farthest, 0.1);
            } else {
                expect_still(motions);
            }
        }
}

/// That forces hold them shows that statics has some: nothing else could stand.
TEST_P(RoundStacks, LargePyramidsStand) {
    struct Pyramid {
        std::string of;
        int rows;
        double friction;
    };
    Random random(4);
    for (const Pyramid& pyramid :
         {Pyramid{"pipes", 4, 0.6}, Pyramid{"pipes", 7, 0.6}, Pyramid{"capsules", 5, 0.6},
          Pyramid{"balls", 4, 0.6}, Pyramid{"balls", 4, 0.8}, Pyramid{"balls", 5, 0.8}})
        for (const bool drawn : {false, true}) {
            if (!has(collider(), pyramid.of)) continue;
            SCOPED_TRACE(std::to_string(pyramid.rows) + " rows of " + pyramid.of +
                         (drawn ? " at drawn settings" : ""));
            Scene s = scene();
            if (drawn) draw_settings(s.settings, random);
            const double radius = drawn ? random.number(0.05, 1) : 0.2;
            s.materials[0].friction = pyramid.friction;
            add_pyramid(s, pyramid.of, radius, pyramid.rows);
            Simulation simulation(s, colliders(), collider());
            expect_still(motions_between(simulation, 0, 5));
        }
}

}  // namespace
}  // namespace plumb::test
