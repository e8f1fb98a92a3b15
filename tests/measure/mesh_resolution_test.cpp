// SPDX-License-Identifier: MIT
/// Sagittas against those of the circles that the facets stand for.
#include "measure/mesh_resolution.h"

#include "world/shape_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plumb {
namespace {

constexpr double kPi = std::numbers::pi;

/// A torus about y.
Geometry torus(double major, double minor, std::uint32_t around, std::uint32_t across) {
    Geometry g;
    g.kind = ShapeKind::mesh;
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const double u = 2 * kPi * i / around, v = 2 * kPi * j / across;
            const double r = major + minor * std::cos(v);
            g.vertices.emplace_back(r * std::cos(u), minor * std::sin(v), r * std::sin(u));
            const auto at = [&](std::uint32_t p, std::uint32_t q) {
                return (p % around) * across + q % across;
            };
            g.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
            g.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        }
    return g;
}

TEST(MeshResolution, TorusHasAboutTheSagittasOfBothItsCircles) {
    for (const std::uint32_t across : {12u, 24u}) {
        ShapeStore store;
        const MeshResolution r = mesh_resolution(store.add(torus(0.5, 0.2, 2 * across, across)));
        const double tube = 0.2 * (1 - std::cos(kPi / across));
        const double outside = 0.7 * (1 - std::cos(kPi / (2 * across)));
        EXPECT_NEAR(r.sagitta, tube + outside, 0.25 * (tube + outside)) << across;
        EXPECT_GE(r.longest_edge, 2 * 0.7 * std::sin(kPi / (2 * across)));
    }
}

TEST(MeshResolution, SharpEdgesAreNoBends) {
    Geometry cube;
    cube.kind = ShapeKind::mesh;
    for (int i = 0; i < 8; ++i) cube.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    cube.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    ShapeStore store;
    const MeshResolution r = mesh_resolution(store.add(cube));
    EXPECT_EQ(r.sagitta, 0);
    EXPECT_NEAR(r.longest_edge, std::sqrt(2.0), 1e-12);
}

TEST(MeshResolution, OtherShapesHaveNone) {
    Geometry ball;
    ball.radius = 1;
    ShapeStore store;
    const MeshResolution r = mesh_resolution(store.add(ball));
    EXPECT_EQ(r.sagitta, 0);
    EXPECT_EQ(r.longest_edge, 0);
}

}  // namespace
}  // namespace plumb
