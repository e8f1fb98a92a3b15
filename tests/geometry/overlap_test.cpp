// SPDX-License-Identifier: MIT
/// Overlap of shapes against formulas, a little nearer and a little farther than where they touch.
#include "geometry/overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.h"
#include "scene/build.h"

namespace plumb::test {

namespace {

using Eigen::Vector3d;

/// Expects shapes to overlap at b's place less 1 mm, and not at the place plus 1 mm, along `away`.
void expect_touch(const Geometry& a, const Geometry& b, const Vector3d& away, double distance,
                  const Eigen::Quaterniond& turn_b = Eigen::Quaterniond::Identity()) {
    plumb::Random random(7);
    for (int i = 0; i < 50; ++i) {
        const Placement all{Vector3d(random.between(-1, 1), random.between(-1, 1), 3),
                            random.rotation()};
        for (const double off : {-1e-3, 1e-3}) {
            const Placement at_b{(distance + off) * away.normalized(), turn_b};
            EXPECT_EQ(overlap(a, all, b, all * at_b), off < 0) << i;
            EXPECT_EQ(overlap(b, all * at_b, a, all), off < 0) << i;
        }
    }
}

}  // namespace

TEST(Overlap, OfSpheres) {
    expect_touch(sphere(0.5), sphere(0.25), {1, 0, 0}, 0.75);
    expect_touch(sphere(0.5), sphere(0.25), {1, 2, 3}, 0.75);
    EXPECT_TRUE(overlap(sphere(1), {}, sphere(1), {}));
}

TEST(Overlap, OfBoxes) {
    const Geometry b = box({1, 0.5, 0.25});
    expect_touch(b, b, {1, 0, 0}, 2);
    expect_touch(b, b, {0, 0, 1}, 0.5);
    // An edge turned by 45° stands out by √2 times its half.
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(std::atan(1.0), Vector3d::UnitY()));
    expect_touch(box({1, 1, 1}), box({1, 1, 1}), {1, 0, 0}, 1 + std::sqrt(2.0), turned);
    expect_touch(box({1, 1, 1}), sphere(0.5), {1, 1, 1}, std::sqrt(3.0) + 0.5);
}

TEST(Overlap, OfCylinders) {
    const Geometry c = cylinder(0.5, 2);
    expect_touch(c, c, {0, 1, 0}, 4);
    expect_touch(c, c, {1, 0, 1}, 1);
    const Eigen::Quaterniond crossed(Eigen::AngleAxisd(2 * std::atan(1.0), Vector3d::UnitX()));
    expect_touch(c, c, {1, 0, 0}, 1, crossed);
    expect_touch(c, c, {0, 0, 1}, 2.5, crossed);
}

TEST(Overlap, OfHullsAndCompounds) {
    Geometry tetrahedron;
    tetrahedron.kind = ShapeKind::hull;
    tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    // Its slanted face lies 1/√3 from the corner that is the origin.
    expect_touch(tetrahedron, sphere(0.5), {1, 1, 1}, 1 / std::sqrt(3.0) + 0.5);

    Geometry pair;
    pair.kind = ShapeKind::compound;
    pair.parts = {{sphere(0.5), {Vector3d(-1, 0, 0), Eigen::Quaterniond::Identity()}},
                  {sphere(0.25), {Vector3d(1, 0, 0), Eigen::Quaterniond::Identity()}}};
    expect_touch(pair, sphere(0.5), {1, 0, 0}, 1.75);
    EXPECT_FALSE(overlap(pair, {}, sphere(0.4), {}));
}

}  // namespace plumb::test
