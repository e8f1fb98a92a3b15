// SPDX-License-Identifier: MIT
/// The same bits of deformables, run after run, on any number of threads and any width of lanes.
#include "kernels/contact_kernels.h"
#include "support/scenes.h"
#include "support/soft_scenes.h"

#include <algorithm>

namespace plumb::test {
namespace {

class SoftDeterminism : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, SoftDeterminism, each_precision(), precision_name);

std::uint64_t hash_of(Precision precision, std::uint32_t threads, std::uint32_t lanes,
                      std::uint32_t exact = 0) {
    Scene s = soft_scene();
    s.settings.exact_deformables = exact;
    s.settings.precision = precision;
    s.settings.threads = threads, s.settings.lanes = lanes;
    Simulation simulation(s, colliders(), "reference");
    std::vector<std::uint8_t> touched(s.deformables.size(), 0);
    for (int i = 0; i < 50; ++i) {
        EXPECT_TRUE(simulation.step().finite);
        for (const Contact& c : simulation.world().particle_contacts.found)
            touched[simulation.world().particles.deformable[c.a]] = 1;
    }
    EXPECT_EQ(std::count(touched.begin(), touched.end(), 1), 5) << "one has touched nothing";
    return state_hash(simulation.world());
}

TEST_P(SoftDeterminism, SameBitsForAnyThreadsAndLanes) {
    const std::uint64_t hash = hash_of(GetParam(), 1, 1);
    EXPECT_EQ(hash_of(GetParam(), 1, 1), hash) << "run twice";
    for (const std::uint32_t threads : {1u, 2u, 4u})
        for (const std::uint32_t lanes : {1u, 4u, 8u, 16u})
            if (static_cast<int>(lanes) <= widest_lanes()) {
                EXPECT_EQ(hash_of(GetParam(), threads, lanes), hash)
                    << threads << " threads, " << lanes << " lanes";
            }
}

TEST_P(SoftDeterminism, SameBitsAsOneSystem) {
    const std::uint64_t hash = hash_of(GetParam(), 1, 1, 10000);
    EXPECT_NE(hash, hash_of(GetParam(), 1, 1));
    EXPECT_EQ(hash_of(GetParam(), 2, 4, 10000), hash);
    EXPECT_EQ(hash_of(GetParam(), 4, 0, 10000), hash);
}

/// What tears, and when, does not depend on threads and lanes either.
TEST_P(SoftDeterminism, SameTearsForAnyThreadsAndLanes) {
    const auto run = [&](std::uint32_t threads, std::uint32_t lanes) {
        Scene s = shot_through_a_sheet();
        s.settings.precision = GetParam();
        s.settings.threads = threads, s.settings.lanes = lanes;
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 0.4);
        return std::pair(state_hash(simulation.world()), simulation.world().deformables[0].torn);
    };
    const auto first = run(1, 1);
    EXPECT_GT(first.second.size(), 10u);
    EXPECT_EQ(run(2, 4), first);
    EXPECT_EQ(run(4, 0), first);
}

}  // namespace
}  // namespace plumb::test
