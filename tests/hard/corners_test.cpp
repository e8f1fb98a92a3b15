// SPDX-License-Identifier: MIT
/// Balls and boxes side by side on the ground, the first of them a little inside of a wall, and
/// some of all inside of another. A ball that rolls off a wall slips along it as fast as it leaves:
/// with much friction, that takes more than to shift what slips and to solve again.
#include "support/random.h"
#include "support/scenes.h"

#include <cmath>

namespace plumb::test {
namespace {

class Corners : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Corners, every_collider(), where_name);

/// Two or three in a row, as deep in what they touch as from a millionth to a hundredth of a
/// radius.
void add_row(Scene& s, Random& random, double radius) {
    const double deep = radius * std::pow(10, random.number(-6, -2));
    const std::uint32_t count = 2 + random.below(2);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double x = (2 * i + 1) * radius - deep * (1 + random.number(0, 1));
        if (i > 0 && random.below(2) == 0)
            add_body(s, box(radius, radius, radius), {x, radius, 0});
        else
            add_body(s, sphere(radius), {x, radius - deep * random.number(0, 1), 0});
    }
}

TEST_P(Corners, WhatIsPushedOffAWallIsSolvedAndRests) {
    Random random(17);
    for (int draw = 0; draw < 40; ++draw) {
        Scene s = scene();
        const double radius = random.number(0.05, 0.5);
        Material& m = s.materials[0];
        m.friction = random.number(0.3, 1.2);
        m.rolling_friction = m.spinning_friction = random.number(0.01, 0.03) * radius;
        add_ground(s);
        add_body(s, box(0.5, 2, 3), {-0.5, 1, 0}, Motion::fixed);
        if (draw % 2 == 0) add_body(s, box(3, 2, 0.5), {0, 1, -0.5 - radius}, Motion::fixed);
        add_row(s, random, radius);
        s.settings.dt = random.number(0.002, 0.02);
        s.settings.substeps = 1 + random.below(20);
        s.settings.velocity_iterations = 1 + random.below(8);
        s.settings.position_iterations = 1 + random.below(8);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", friction " << m.friction << ", "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 2);
        double fastest = 0;
        std::uint32_t unsolved = 0;
        while (simulation.time() < 3) {
            unsolved += simulation.step().unsolved_islands;
            fastest = std::max(fastest, fastest_point(simulation.world()));
        }
        EXPECT_EQ(unsolved, 0u);
        EXPECT_LT(fastest, 1e-4);
    }
}

}  // namespace
}  // namespace plumb::test
