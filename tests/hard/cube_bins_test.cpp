// SPDX-License-Identifier: MIT
/// Cubes in a bin that is a little wider than five of them: rows of cubes are wedged between the
/// walls, and their overlaps contradict each other. The heap comes to rest all the same.
#include "support/random.h"
#include "support/scenes.h"

#include <cstdlib>

namespace plumb::test {
namespace {

constexpr double kCube = 0.05, kWall = 0.27;  // half of an edge, and of the bin [m]

/// How many cubes: 120, or as many as the environment asks for.
std::uint32_t cube_count() {
    const char* const asked = std::getenv("PLUMB_BINNED_CUBES");
    return asked ? static_cast<std::uint32_t>(std::atoi(asked)) : 120;
}

Scene bin_of_cubes(Scene s) {
    s.materials[0].rolling_friction = 0.005;
    add_ground(s);
    for (const Vector& d : {Vector(1, 0, 0), Vector(-1, 0, 0), Vector(0, 0, 1), Vector(0, 0, -1)}) {
        const Vector half = Vector(kWall + 0.4, 6, kWall + 0.4) - (kWall + 0.2) * d.cwiseAbs();
        add_body(s, box(half.x(), half.y(), half.z()), (kWall + 0.2) * d + Vector(0, 6, 0),
                 Motion::fixed);
    }
    Random random(3);
    for (std::uint32_t i = 0; i < cube_count(); ++i) {
        const double x = i % 3 - 1.0, z = (i / 3) % 3 - 1.0, layer = i / 9;
        add_body(s, box(kCube, kCube, kCube), {0.175 * x, 0.1 + 0.18 * layer, 0.175 * z})
            .placement.rotation = random.rotation();
    }
    return s;
}

class CubeBins : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, CubeBins, every_collider(), where_name);

TEST_P(CubeBins, ComeToRest) {
    Simulation simulation(bin_of_cubes(scene()), colliders(), collider());
    run_for(simulation, 14);
    EXPECT_LT(motions_between(simulation, 14, 16).fastest, 2e-3);
    double deepest = 0;
    for (const double depth : penetrations(simulation.world())) deepest = std::max(deepest, depth);
    EXPECT_LT(deepest, 0.01 * kCube);
}

}  // namespace
}  // namespace plumb::test
