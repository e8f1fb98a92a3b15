// SPDX-License-Identifier: MIT
/// Bodies that start deep in each other part without an explosion.
#include "support/scenes.h"

#include <algorithm>

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
