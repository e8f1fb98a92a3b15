// SPDX-License-Identifier: MIT
/// How far two moments are apart: a deformable counts as one thing, however finely it is divided.
#include "study/trajectory.h"

#include "support/scenes.h"
#include "support/soft.h"

#include <utility>

namespace plumb::test {
namespace {

/// A ball and a sheet of so many cells, 2 m wide.
World ball_and_sheet(std::array<std::uint32_t, 2> cells) {
    Scene scene;
    add_body(scene, sphere(0.1), {0, 3, 0}).mass = 1;
    add_soft(scene, sheet(cells, {2, 2}, {0, 1, 0})).mass = 1;
    return build_world(scene);
}

/// Distances between a world and one whose sheet was moved, point by point.
template <class Way>
std::vector<double> moved(World world, Way way) {
    const study::Moment before = study::moment_of(world);
    for (Vector& p : world.particles.position) p += way(p);
    return study::distances(before, study::moment_of(world));
}

TEST(Distances, AreThoseOfBodiesThenOfDeformables) {
    const auto apart = moved(ball_and_sheet({5, 5}), [](const Vector&) { return Vector(3, 4, 0); });
    ASSERT_EQ(apart.size(), 2u);
    EXPECT_EQ(apart[0], 0);
    EXPECT_NEAR(apart[1], 5, 1e-12);
}

/// Lifted by x, the root of the mean square is that of the way, 1/√3; lumped masses are off by the
/// square of a cell.
TEST(Distances, DoNotDependOnTheNumberOfParticles) {
    for (const std::array<std::uint32_t, 2> cells :
         {std::array{4u, 4u}, std::array{20u, 20u}, std::array{60u, 4u}, std::array{4u, 40u}}) {
        const auto apart =
            moved(ball_and_sheet(cells), [](const Vector& p) { return Vector(0, p.x(), 0); });
        EXPECT_NEAR(apart[1], std::sqrt(1.0 / 3), 0.6 / (cells[0] * cells[0])) << cells[0];
    }
}

/// A mesh that is finer in one half alone does not count that half for more.
TEST(Distances, WeighParticlesByTheirMass) {
    Scene scene;
    DeformableSpec uneven = rope({0, 0, 0}, {1, 0, 0}, 50);
    uneven.points.emplace_back(2, 0, 0);
    uneven.segments.push_back({50, 51});
    add_soft(scene, uneven).mass = 1;
    const auto apart = moved(build_world(scene),
                             [](const Vector& p) { return Vector(0, p.x() > 0.5 ? 1 : 0, 0); });
    EXPECT_NEAR(apart[0], std::sqrt(0.75), 0.005);
}

TEST(Moments, CountADeformableAsABody) {
    const study::Moment m = study::moment_of(ball_and_sheet({7, 3}));
    EXPECT_NEAR(m.height, 2, 1e-12);
    EXPECT_NEAR(m.strain, 0, 1e-12);
    EXPECT_EQ(m.speed, 0);
    EXPECT_NEAR(m.energy, 4 * 9.81, 1e-9);
}

}  // namespace
}  // namespace plumb::test
