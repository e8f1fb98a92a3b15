// SPDX-License-Identifier: MIT
/// Strains and volumes of shapes that were stretched by hand.
#include "measure/deformation.h"

#include "support/scenes.h"
#include "support/soft.h"

namespace plumb::test {
namespace {

/// One of each kind, every point moved.
template <class Map>
World mapped(Map map) {
    Scene scene;
    add_soft(scene, rope({0, 0, 0}, {1, 0, 0}, 5));
    add_soft(scene, sheet({3, 4}, {1, 2}));
    add_soft(scene, balloon(0.5, 3)).volume_ratio = 1.331;
    add_soft(scene, block({0.5, 0.5, 0.5}, {2, 2, 2}));
    World world = build_world(scene);
    for (Vector& p : world.particles.position) p = map(p);
    return world;
}

TEST(Deformation, OfWhatOnlyMovedIsNone) {
    const Rotation turn(Eigen::AngleAxisd(1, Vector(1, 2, 3).normalized()));
    const World world = mapped([&](const Vector& p) { return Vector(turn * p + Vector(9, 8, 7)); });
    for (const double strain : strains(world)) EXPECT_NEAR(strain, 0, 1e-12);
}

TEST(Deformation, IsTheStretchLessOne) {
    const World world = mapped([](const Vector& p) { return Vector(1.1 * p); });
    ASSERT_EQ(strains(world).size(), 4u);
    for (const double strain : strains(world)) EXPECT_NEAR(strain, 0.1, 1e-12);
    ASSERT_EQ(volume_errors(world).size(), 1u);
    EXPECT_NEAR(volume_errors(world)[0], 0, 1e-12);
    EXPECT_NEAR(volume_inside(world, world.deformables[3]), 1.331, 1e-12);
}

TEST(Deformation, OfWhatIsTornWhollyIsNone) {
    World world = mapped([](const Vector& p) { return Vector(1.1 * p); });
    world.deformables[1].spec.triangles.clear();
    EXPECT_EQ(strains(world)[1], 0);
}

TEST(Deformation, TellsHowMuchAVolumeIsOff) {
    const World world = mapped([](const Vector& p) { return p; });
    EXPECT_NEAR(volume_errors(world)[0], 1 / 1.331 - 1, 1e-12);
}

TEST(Deformation, HasItsCentreByMass) {
    const World world = mapped([](const Vector& p) { return Vector(p + Vector(1, 2, 3)); });
    EXPECT_LT((centre_of(world, world.deformables[0]) - Vector(1.5, 2, 3)).norm(), 1e-12);
    EXPECT_LT((centre_of(world, world.deformables[3]) - Vector(1, 2, 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace plumb::test
