// SPDX-License-Identifier: MIT
/// Heavy bodies on light ones stand where they were put, from the first step on, and where they
/// fall on them they do not sink in.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

class MassRatios : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, MassRatios, every_collider(), where_name);

/// Cubes on each other; returns how far any has come from its place within a second, in edges.
double moved_of(Scene s, const std::string& collider, double edge,
                const std::vector<double>& masses) {
    add_ground(s);
    for (std::size_t i = 0; i < masses.size(); ++i)
        add_body(s, box(edge / 2, edge / 2, edge / 2), {0, edge * (0.5 + double(i)), 0}).mass =
            masses[i];
    Simulation simulation(s, colliders(), collider);
    const std::vector<Vector> start = simulation.world().bodies.position;
    run_for(simulation, 1);
    return farthest_from(start, simulation.world()) / edge;
}

TEST_P(MassRatios, HeavyOnLightStands) {
    Random random(3);
    for (int draw = 0; draw < 60; ++draw) {
        Scene s = scene();
        s.settings.dt = random.number(0.002, 0.02);
        s.settings.substeps = 1 + random.below(4);
        s.settings.velocity_iterations = s.settings.position_iterations = 3 + random.below(10);
        const double edge = 0.02 * std::pow(25, random.number(0, 1));
        const double ratio = std::pow(10, random.number(1, 5));
        std::vector<double> masses(2 + random.below(9), 1.0);
        if (draw % 3 == 0)
            masses.back() = ratio;  // the top alone
        else if (draw % 3 == 1)
            masses = {1, ratio};
        else
            for (std::size_t i = 1; i < masses.size(); i += 2) masses[i] = std::sqrt(ratio);
        EXPECT_LT(moved_of(s, collider(), edge, masses), 1e-4)
            << masses.size() << " cubes of " << edge << " m, 1 : " << ratio << ", " << s.settings.dt
            << " s x " << s.settings.substeps;
    }
}

/// The deepest overlap until `end` [m].
double deepest_until(Simulation& simulation, double end) {
    double deepest = 0;
    while (simulation.time() < end) {
        simulation.step();
        for (const Contact& c : simulation.world().contacts.found)
            deepest = std::max(deepest, -c.gap);
    }
    return deepest;
}

/// Boxes that are let go one above the other, a gap between each two.
TEST_P(MassRatios, TowersThatFallOntoEachOtherDoNotSinkIn) {
    Random random(11);
    for (int draw = 0; draw < 8; ++draw) {
        Scene s = scene();
        draw_steps(s.settings, random, {0.004, 1.0 / 60, 3, 3, 12});
        const int count = 9 + static_cast<int>(random.below(8));
        const double ratio = std::pow(10, random.number(1, 4)), half = random.number(0.05, 0.3);
        const double space = half * random.number(0.02, 0.5);
        add_ground(s);
        for (int i = 0; i < count; ++i) {
            const bool heavy = draw % 2 == 0 ? i % 2 == 1 : i == count - 1;
            add_body(s, box(half, half, half), {0, half + space + i * (2 * half + space), 0}).mass =
                heavy ? ratio : 1;
        }
        SCOPED_TRACE(testing::Message()
                     << count << " boxes, 1 : " << ratio << ", " << space << " m apart, "
                     << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        EXPECT_LT(deepest_until(simulation, 4), 1e-3 * half);
        EXPECT_LT(fastest_point(simulation.world()), 1e-4);
        for (const Vector& position : simulation.world().bodies.position)
            EXPECT_LT(std::hypot(position.x(), position.z()), 0.1 * half);
    }
}

/// A slab that is let go on a square of balls.
TEST_P(MassRatios, ShipsOnFloatsDoNotSinkIn) {
    Random random(12);
    for (int draw = 0; draw < 8; ++draw) {
        Scene s = scene();
        draw_steps(s.settings, random, {0.004, 1.0 / 60, 3, 3, 12});
        const int side = 2 + static_cast<int>(random.below(4));
        const double radius = random.number(0.05, 0.3), space = 2.4 * radius;
        const double ratio = std::pow(10, random.number(1, 6));
        const double above = draw % 2 == 0 ? 0 : radius * random.number(0, 2);
        add_ground(s);
        for (int x = 0; x < side; ++x)
            for (int z = 0; z < side; ++z)
                add_body(s, sphere(radius),
                         {space * (x - 0.5 * (side - 1)), radius, space * (z - 0.5 * (side - 1))})
                    .mass = 1;
        const double half = 0.5 * space * side;
        add_body(s, box(half, radius, half), {0, 3 * radius + above, 0}).mass = ratio;
        SCOPED_TRACE(testing::Message() << side << " x " << side << " balls of " << radius
                                        << " m, 1 : " << ratio << ", from " << above << " m, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        EXPECT_LT(deepest_until(simulation, 3), 1e-3 * radius);
    }
}

}  // namespace
}  // namespace plumb::test
