// SPDX-License-Identifier: MIT
/// Bodies that start deep in each other part without an explosion.
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

class Overlap : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Overlap, every_collider(), where_name);

TEST_P(Overlap, PartsAtNoMoreThanTheSetSpeed) {
    for (double share : {0.5, 0.75, 1.0}) {  // 1.0: coincident centres
        Scene s = scene();
        s.settings.gravity.setZero();
        add_body(s, box(0.25, 0.25, 0.25), {0, 0, 0});
        add_body(s, box(0.25, 0.25, 0.25), {0.5 * (1 - share), 0, 0});
        Simulation simulation(s, colliders(), collider());
        double fastest = 0;
        for (int i = 0; i < 200; ++i) {
            ASSERT_TRUE(simulation.step().finite);
            const Bodies& b = simulation.world().bodies;
            fastest = std::max(fastest, (b.velocity[0] - b.velocity[1]).norm());
        }
        EXPECT_LT(fastest, 1.1 * s.settings.recovery_speed) << share;
        double deepest = 0;
        for (double depth : penetrations(simulation.world())) deepest = std::max(deepest, depth);
        EXPECT_LT(deepest, 1e-3) << "clear within 2 s, from an overlap of " << share;
    }
}

/// What is thrown by the push-out comes down askew: gravity takes its speed back within 4 % of the
/// body's radius. Small bodies in no gravity to speak of take a second for a radius.
TEST_P(Overlap, PartsNoFasterThanGravityTakesBack) {
    Random random(17);
    for (int draw = 0; draw < 12; ++draw) {
        const double half = std::pow(10, random.number(-1.7, -0.2)), radius = std::sqrt(3) * half,
                     gravity = std::pow(10, random.number(-2, 1.5));
        Scene s = scene();
        s.settings.gravity = {0, -gravity, 0};
        s.settings.dt = random.number(0.004, 0.02);
        s.settings.substeps = 1 + random.below(8);
        s.materials[0].friction = 0;
        add_ground(s);
        add_body(s, box(half, half, half), {0, half, 0});
        add_body(s, box(half, half, half), {half, half, 0});
        Simulation simulation(s, colliders(), collider());
        const double most = std::min(s.settings.recovery_speed,
                                     std::max(std::sqrt(2 * gravity * 0.04 * radius), radius));
        double fastest = 0;
        while (simulation.time() < 0.5 * half / most) {
            ASSERT_TRUE(simulation.step().finite);
            const Bodies& b = simulation.world().bodies;
            fastest = std::max(fastest, (b.velocity[1] - b.velocity[2]).norm());
        }
        SCOPED_TRACE("draw " + std::to_string(draw));
        EXPECT_LT(fastest, 1.05 * most);
        EXPECT_GT(fastest, 0.9 * most) << "and no slower";
    }
}

/// Eight cubes in a row, each 1 mm into the next, with seven on top: 7 mm to make room for, 3.5 at
/// either end, whatever the steps and substeps.
TEST_P(Overlap, OpensByItsSizeHoweverShortTheSubsteps) {
    for (const auto& [dt, substeps] :
         {std::pair{0.01, 1u}, {0.01, 20u}, {0.001, 1u}, {0.015, 3u}}) {
        Scene s = scene();
        s.settings.dt = dt, s.settings.substeps = substeps;
        add_ground(s);
        for (int row = 0; row < 2; ++row)
            for (int i = 0; i < 8 - row; ++i)
                add_body(s, box(0.2, 0.2, 0.2), {0.399 * (i + 0.5 * row), 0.2 + 0.4 * row, 0});
        Simulation simulation(s, colliders(), collider());
        EXPECT_LT(motions_between(simulation, 0, 0.5).farthest, 5e-3) << dt << " s x " << substeps;
    }
}

TEST_P(Overlap, IsRepeatable) {
    std::uint64_t hashes[2];
    for (std::uint64_t& hash : hashes) {
        Scene s = scene();
        for (int i = 0; i < 8; ++i)
            add_body(s, i % 2 ? box(0.2, 0.2, 0.2) : sphere(0.2), {0, 0, 0});
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 1);
        hash = state_hash(simulation.world());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(OverlapClamp, IsCounted) {
    Scene s;
    add_body(s, box(0.25, 0.25, 0.25), {0, 0, 0});
    add_body(s, box(0.25, 0.25, 0.25), {0.2, 0, 0});
    Simulation simulation(s, colliders(), "reference");
    EXPECT_GT(simulation.step().clamped_recoveries, 0u);
}

}  // namespace
}  // namespace plumb::test
