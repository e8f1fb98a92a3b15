// SPDX-License-Identifier: MIT
#include "output/view.h"

#include "falling.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plumb::test {
namespace {

/// Whether a ball lies within the pyramid of the picture.
bool visible(const View& view, const Ball& ball, const Eigen::Vector3d& up, double aspect) {
    const Eigen::Vector3d back = (view.eye - view.target).normalized();
    const Eigen::Vector3d right = up.cross(back).normalized(), above = back.cross(right);
    const double tangent = std::tan(0.5 * view.field_of_view * std::numbers::pi / 180);
    const Eigen::Vector3d p = ball.centre - view.eye;
    const double depth = -p.dot(back);
    const auto inside = [&](double off, double t) {
        return (depth * t - std::abs(off)) / std::hypot(1.0, t) >= ball.radius;
    };
    return depth > 0 && inside(p.dot(right), tangent * aspect) && inside(p.dot(above), tangent);
}

TEST(FittedView, HoldsAllBallsButFarOutliers) {
    for (const Eigen::Vector3d& up :
         {Eigen::Vector3d::UnitX().eval(), Eigen::Vector3d::UnitY().eval(),
          Eigen::Vector3d::UnitZ().eval()}) {
        std::vector<Ball> balls;
        for (int i = 0; i < 50; ++i) {
            balls.push_back(
                {{100 + std::sin(1.0 * i), std::cos(2.0 * i), 0.3 * std::sin(3.0 * i)}, 0.2});
        }
        const View without = fitted_view(balls, up, 1.5);
        std::vector<Ball> with_outlier = balls;
        with_outlier.push_back({{100, -1e5, 0}, 0.2});
        const View with = fitted_view(with_outlier, up, 1.5);
        for (const Ball& ball : balls) {
            EXPECT_TRUE(visible(without, ball, up, 1.5));
            EXPECT_TRUE(visible(with, ball, up, 1.5));
        }
        EXPECT_LT((with.eye - without.eye).norm(), 1);
        EXPECT_GT((without.eye - without.target).dot(up), 0);
        EXPECT_LT((without.eye - without.target).norm(), 12);
    }
}

TEST(ChosenView, IsTheScenesUnlessItCannotBeDrawn) {
    RecordingHeader header;
    const std::vector<Ball> balls{{{0, 1, 0}, 0.5}};
    header.view = View{{1, 2, 3}, {0, 0, 0}, 50};
    EXPECT_EQ(chosen_view(header, balls, 1.5).eye, header.view->eye);
    for (const View& bad : {View{{1, 2, 3}, {1, 2, 3}, 50}, View{{1, 2, 3}, {0, 0, 0}, 0},
                            View{{std::nan(""), 2, 3}, {0, 0, 0}, 50}}) {
        header.view = bad;
        EXPECT_TRUE(visible(chosen_view(header, balls, 1.5), balls[0], {0, 1, 0}, 1.5));
    }
}

TEST(BoundingRadius, IsTheFarthestPoint) {
    EXPECT_DOUBLE_EQ(bounding_radius(sphere(2)), 2);
    EXPECT_DOUBLE_EQ(bounding_radius(box(1, 2, 2)), 3);
    EXPECT_DOUBLE_EQ(bounding_radius(capsule(1, 2)), 3);
    EXPECT_DOUBLE_EQ(bounding_radius(cone(3, 4)), 5);
    EXPECT_DOUBLE_EQ(bounding_radius(hull(0.5)), 0.5);
    EXPECT_DOUBLE_EQ(bounding_radius(compound(1)), 3);
}

}  // namespace
}  // namespace plumb::test
