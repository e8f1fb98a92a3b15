// SPDX-License-Identifier: MIT
/// The paper's pile (§8): 2000 bodies, 0.01 s, 5 + 5 iterations, on two colliders. Over the last 2
/// s, sampled each 0.1 s, over the bodies within 8 m of the axis (without rolling friction some
/// balls roll away).
#include "reader/reader.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

namespace plumb::test {
namespace {

struct Pile {
    double median_speed = 0, p90_speed = 0;             ///< greatest of the samples [m/s]
    double mean_depth = 0, p99_depth = 0, deepest = 0;  ///< greatest of the samples [m]
    std::size_t contacts = 0, away = 0, fallen = 0;
    double mean_height = 0;  ///< of those near the axis [m]
};

void sample(const World& world, Pile& pile) {
    std::vector<double> speeds;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        if (world.bodies.motion[i] == Motion::dynamic &&
            std::hypot(world.bodies.position[i].x(), world.bodies.position[i].z()) <= 8)
            speeds.push_back(world.bodies.velocity[i].norm());
    pile.median_speed = std::max(pile.median_speed, percentile(speeds, 0.5));
    pile.p90_speed = std::max(pile.p90_speed, percentile(speeds, 0.9));
    const std::vector<double> depths = penetrations(world);
    double sum = 0;
    for (double d : depths) sum += d;
    pile.mean_depth =
        std::max(pile.mean_depth, depths.empty() ? 0 : sum / static_cast<double>(depths.size()));
    pile.p99_depth = std::max(pile.p99_depth, percentile(depths, 0.99));
    pile.deepest = std::max(pile.deepest, percentile(depths, 1));
}

const Pile& settled_pile(const std::string& collider) {
    static std::map<std::string, Pile> piles;
    if (const auto known = piles.find(collider); known != piles.end()) return known->second;
    Pile& pile = piles[collider];
    const Scene scene = read_scene(PLUMB_TEST_SCENES "/pile.json");
    Simulation simulation(scene, colliders(), collider);
    const World& world = simulation.world();
    for (int i = 1; i <= 1000; ++i) {
        EXPECT_TRUE(simulation.step().finite);
        if (i >= 800 && i % 10 == 0) sample(world, pile);
    }
    pile.contacts = world.contacts.found_before.size();
    std::size_t near = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
        if (world.bodies.motion[i] != Motion::dynamic) continue;
        const Vector& x = world.bodies.position[i];
        pile.fallen += x.y() < 0;
        if (std::hypot(x.x(), x.z()) > 8) {
            ++pile.away;
            continue;
        }
        pile.mean_height += x.y();
        ++near;
    }
    pile.mean_height /= static_cast<double>(near);
    std::cout << collider << ": speed median " << pile.median_speed * 1e3 << ", 90 % "
              << pile.p90_speed * 1e3 << " mm/s; penetration mean " << pile.mean_depth * 1e3
              << ", 99 % " << pile.p99_depth * 1e3 << ", largest " << pile.deepest * 1e3 << " mm; "
              << pile.contacts << " contacts, " << pile.away << " rolled away, mean height "
              << pile.mean_height << " m\n";
    return pile;
}

class PileOfTwoThousand : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, PileOfTwoThousand, testing::Values("ode", "bullet", "fcl"),
                         [](const auto& which) { return which.param; });

TEST_P(PileOfTwoThousand, ComesToRestWithoutSleeping) {
    const Pile& pile = settled_pile(GetParam());
    EXPECT_LE(pile.median_speed, 1e-3);
    EXPECT_LE(pile.p90_speed, 5e-3);
    EXPECT_LE(pile.mean_depth, 0.2e-3);
    EXPECT_LE(pile.p99_depth, 1e-3);
    EXPECT_LE(pile.deepest, 20e-3);
    EXPECT_GT(pile.contacts, 4000u);
    EXPECT_EQ(pile.fallen, 0u);
}

TEST(PileOnThreeColliders, IsAsHighOnEach) {
    for (const char* other : {"bullet", "fcl"})
        EXPECT_NEAR(settled_pile("ode").mean_height / settled_pile(other).mean_height, 1, 0.03)
            << other;
}

}  // namespace
}  // namespace plumb::test
