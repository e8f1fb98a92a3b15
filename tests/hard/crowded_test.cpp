// SPDX-License-Identifier: MIT
/// Many constraints on one body: static ones take no colours, dynamic ones overflow into an order
/// of their own.
#include "schedule/colouring.h"
#include "support/scenes.h"

#include <set>

namespace plumb::test {
namespace {

TEST(Crowded, FiveHundredBodiesHangOnOneAnchor) {
    Scene s;
    use_fine_steps(s.settings);
    add_body(s, sphere(0.01), {0, 0, 0}, Motion::fixed);
    for (std::uint32_t i = 0; i < 500; ++i) {
        const double angle = 2 * std::numbers::pi * i / 500;
        add_body(s, sphere(0.01), {std::cos(angle), 0, std::sin(angle)}).mask = 0;
        JointSpec joint;
        joint.body_a = i + 1, joint.body_b = 0;
        s.joints.push_back(joint);
    }
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    for (double error : joint_errors(simulation.world())) EXPECT_LT(error, 1e-5);
}

TEST(Crowded, FiveHundredBallsRestOnOneDynamicPlate) {
    std::set<std::uint64_t> hashes;
    for (std::uint32_t threads : {1u, 2u, 4u}) {
        Scene s;
        s.settings.threads = threads;
        add_ground(s);
        add_body(s, box(12, 0.1, 12), {0, 0.1, 0});
        for (int i = 0; i < 500; ++i)
            add_body(s, sphere(0.4), {i % 25 - 12.0, 0.61, i / 25 - 10.0});
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 2);
        for (std::size_t i = 2; i < 502; ++i)
            EXPECT_NEAR(simulation.world().bodies.position[i].y(), 0.6, 0.005);
        hashes.insert(state_hash(simulation.world()));
    }
    EXPECT_EQ(hashes.size(), 1u) << "the same bits on any number of threads";
}

TEST(Crowded, ColoursShareNoDynamicBodyAndIgnoreStaticOnes) {
    std::vector<BodyPair> pairs;
    const std::int32_t dynamic = 50, fixed = 50;
    for (std::int32_t i = 0; i < dynamic; ++i) pairs.push_back({i, fixed, 0, 1 + i % 4u, 0});
    for (std::int32_t i = 0; i < dynamic; ++i)
        for (std::int32_t j = i + 1; j < dynamic; j += 1 + i % 3)
            pairs.push_back({i, j, 0, 1 + j % 4u, 0});
    for (std::int32_t k = 0; k < 100; ++k)
        pairs.push_back({0, 1 + k % 49, 0, 1, 0});  // more than there are colours
    Colouring colouring;
    colouring.colour(pairs, dynamic);
    std::set<std::uint32_t> seen;
    bool overflow = false;
    for (const Batch& batch : colouring.batches()) {
        std::set<std::int32_t> bodies;
        for (std::uint32_t i = batch.first; i < batch.last; ++i) {
            const BodyPair& p = pairs[colouring.order()[i]];
            EXPECT_TRUE(seen.insert(colouring.order()[i]).second);
            if (!batch.independent) continue;
            EXPECT_TRUE(bodies.insert(p.row_a).second);
            if (p.row_b < dynamic) {
                EXPECT_TRUE(bodies.insert(p.row_b).second);
            }
        }
        overflow |= !batch.independent;
    }
    EXPECT_EQ(seen.size(), pairs.size());
    EXPECT_TRUE(overflow);

    std::vector<BodyPair> on_ground;
    for (std::int32_t i = 0; i < dynamic; ++i) on_ground.push_back({i, fixed, 0, 1, 0});
    colouring.colour(on_ground, dynamic);
    EXPECT_EQ(colouring.batches().size(), 1u) << "bodies on one floor take one colour";
}

}  // namespace
}  // namespace plumb::test
