// SPDX-License-Identifier: MIT
/// Cubes in a bin: rows of them are wedged between the walls, and their overlaps contradict each
/// other. The heap comes to rest all the same. PLUMB_BINNED_CUBES says how many (120).
#include "support/binned_heap.h"
#include "support/environment.h"

#include <cmath>

namespace plumb::test {
namespace {

constexpr double kCube = 0.05;  // half of an edge [m]

class CubeBins : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, CubeBins, every_collider(), where_name);

TEST_P(CubeBins, ComeToRest) {
    const auto count = static_cast<std::uint32_t>(number_from("PLUMB_BINNED_CUBES", 120));
    Scene s = scene();
    add_bin(s, 6);
    add_layers(s, {box(kCube, kCube, kCube)}, count);
    Simulation simulation(s, colliders(), collider());
    EXPECT_LT(motions_between(simulation, 14, 16).fastest, 2e-3);
    double deepest = 0;
    for (const double depth : penetrations(simulation.world())) deepest = std::max(deepest, depth);
    EXPECT_LT(deepest, 0.005 * std::sqrt(3) * kCube) << "a share of the cubes' radius";
}

}  // namespace
}  // namespace plumb::test
