// SPDX-License-Identifier: MIT
#include "geometry/hull.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "geometry/bad_shape.h"
#include "math/random.h"

namespace plumb {

namespace {

using Points = std::vector<Eigen::Vector3d>;

Points box_corners(const Eigen::Vector3d& half, const Eigen::Vector3d& centre) {
    Points points;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        points.push_back(centre + half.cwiseProduct(sign));
    }
    return points;
}

/// Corners minus edges plus faces; 2 for every polyhedron without holes.
long euler_number(const Hull& hull) {
    std::size_t sides = 0;
    for (const auto& face : hull.faces) sides += face.size();
    return static_cast<long>(hull.vertices.size() - sides / 2 + hull.faces.size());
}

/// Newell's normal: its direction tells from where the corners run counter-clockwise.
Eigen::Vector3d normal_of(const Hull& hull, const std::vector<std::uint32_t>& face) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < face.size(); ++i) {
        normal += hull.vertices[face[i]].cross(hull.vertices[face[(i + 1) % face.size()]]);
    }
    return normal.normalized();
}

/// No vertex lies outside of a face by more than `slack` [m].
void expect_convex(const Hull& hull, double slack) {
    for (const auto& face : hull.faces) {
        const Eigen::Vector3d n = normal_of(hull, face);
        for (const auto& v : hull.vertices) EXPECT_LE(n.dot(v - hull.vertices[face[0]]), slack);
    }
}

std::string reason_for(const Points& points) {
    try {
        convex_hull(points);
    } catch (const BadShape& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST(Hull, OfABoxHasSixSquares) {
    Points points = box_corners({1, 2, 3}, {100, -5, 7});
    points.push_back({100, -5, 7});    // inside
    points.push_back({101, -5, 7});    // in a face
    points.push_back({101, -3, 7});    // in an edge
    points.push_back(points.front());  // a corner once more
    const Hull hull = convex_hull(points);
    EXPECT_EQ(hull.vertices.size(), 8u);
    EXPECT_EQ(hull.faces.size(), 6u);
    for (const auto& face : hull.faces) EXPECT_EQ(face.size(), 4u);
    EXPECT_EQ(euler_number(hull), 2);
    expect_convex(hull, 1e-12);
}

TEST(Hull, MergesPolygonsWrittenWithSixDigits) {
    // A prism of twelve sides, turned, its coordinates rounded as in a file.
    const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
    Points points;
    for (int i = 0; i < 24; ++i) {
        const double angle = i / 2 * std::numbers::pi / 6;
        const Eigen::Vector3d p =
            turn * Eigen::Vector3d(std::cos(angle), i % 2 ? 1 : -1, std::sin(angle));
        points.push_back((p * 1e6).array().round() / 1e6);
    }
    const Hull hull = convex_hull(points);
    EXPECT_EQ(hull.vertices.size(), 24u);
    EXPECT_EQ(hull.faces.size(), 14u);
    EXPECT_EQ(euler_number(hull), 2);
    expect_convex(hull, 1e-5);
}

TEST(Hull, OfRandomPointsIsClosedAndConvex) {
    Random random(3);
    for (int round = 0; round < 20; ++round) {
        Points points;
        for (int i = 0; i < 50; ++i)
            points.push_back(random.rotation() * Eigen::Vector3d(random.unit(), 0, 0));
        const Hull hull = convex_hull(points);
        EXPECT_EQ(euler_number(hull), 2);
        expect_convex(hull, 1e-5);
    }
}

TEST(Hull, KeepsItsSizeAtEveryScale) {
    for (const double scale : {1e-5, 1e5}) {
        const Hull hull =
            convex_hull(box_corners(Eigen::Vector3d(1, 1, 0.01) * scale, Eigen::Vector3d::Zero()));
        EXPECT_EQ(hull.faces.size(), 6u);
        EXPECT_EQ(hull.vertices[0].cwiseAbs().x(), scale);
    }
}

TEST(Hull, SaysWhyThereIsNone) {
    EXPECT_NE(reason_for({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).find("at least 4 points"),
              std::string::npos);
    EXPECT_NE(reason_for(Points(9, Eigen::Vector3d(1, 2, 3))).find("the same point"),
              std::string::npos);
    EXPECT_NE(reason_for({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).find("flat"),
              std::string::npos);
    EXPECT_NE(reason_for({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).find("flat"),
              std::string::npos);
    EXPECT_NE(reason_for(box_corners({1, 1, 1e-11}, {0, 0, 0})).find("flat"), std::string::npos);
}

}  // namespace plumb
