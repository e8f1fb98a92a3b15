// SPDX-License-Identifier: MIT
/// Cubes in a bin: rows of them are wedged between the walls, and their overlaps contradict each
/// other. The heap comes to rest all the same. PLUMB_BINNED_CUBES says how many (120).
#include "math/rotation.h"
#include "support/binned_heap.h"
#include "support/draw_settings.h"
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

/// Loose cubes in columns that lean on each other as they fall together: none sways on or topples.
/// Steps are coarse, iterations few.
TEST_P(CubeBins, TowersSideBySideStand) {
    constexpr std::uint32_t kColumns = 4, kHeight = 10;
    Random random(41);
    for (int draw = 0; draw < 6; ++draw) {
        const double half = random.number(0.04, 0.2);
        Scene s = scene();
        draw_steps(s.settings, random, {0.01, 0.02, 2, 3, 5});
        s.materials[0].friction = random.number(0.3, 0.6);
        add_ground(s);
        for (std::uint32_t c = 0; c < kColumns; ++c)
            for (std::uint32_t i = 0; i < kHeight; ++i) {
                const Vector at = half * Vector(2.2 * c, 2.2 * i + 1.1, 0);
                const double tilt = 0.01 * std::sin(7.3 * i + c);
                add_body(s, box(half, half, half), at).placement.rotation =
                    exponential_map(Vector3d(tilt, 0, 0));
            }
        Simulation simulation(s, colliders(), collider());
        SCOPED_TRACE("draw " + std::to_string(draw));
        EXPECT_LT(motions_between(simulation, 4, 5).fastest, 2e-3);
        const double top = 2 * half * (kHeight - 0.5);
        for (std::uint32_t c = 0; c < kColumns; ++c) {
            const Vector3d& at = simulation.world().bodies.position[(c + 1) * kHeight];
            EXPECT_NEAR(at.y(), top, 0.01 * top) << "column " << c;
        }
    }
}

/// Rows of cubes in a slot that is too short for them, deep in each other and with nowhere to go.
TEST_P(CubeBins, RowsTooLongForTheirSlotComeToRest) {
    constexpr std::uint32_t kRow = 6, kRows = 5;
    Random random(17);
    for (int draw = 0; draw < 4; ++draw) {
        const double half = random.number(0.04, 0.2), room = random.number(0.8, 0.95);
        Scene s = scene();
        draw_steps(s.settings, random, {0.005, 0.017, 3, 3, 10});
        s.materials[0].friction = random.number(0.2, 1);
        add_ground(s);
        const double wide = room * kRow * half, deep = 1.05 * half, high = 4 * kRows * half;
        for (const double side : {-1.0, 1.0}) {
            add_body(s, box(half, high, 4 * half), {side * (wide + half), high, 0}, Motion::fixed);
            add_body(s, box(wide, high, half), {0, high, side * (deep + half)}, Motion::fixed);
        }
        for (std::uint32_t k = 0; k < kRow * kRows; ++k) {
            const Vector at =
                half * Vector(room * (2.0 * (k % kRow) + 1 - kRow), 2.2 * (k / kRow) + 1.1, 0);
            const Vector3d tilt = 0.02 * random.vector();
            add_body(s, box(half, half, half), at).placement.rotation = exponential_map(tilt);
        }
        Simulation simulation(s, colliders(), collider());
        SCOPED_TRACE("draw " + std::to_string(draw));
        EXPECT_LT(motions_between(simulation, 9, 10).fastest, 5e-3);
    }
}

}  // namespace
}  // namespace plumb::test
