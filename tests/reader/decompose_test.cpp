// SPDX-License-Identifier: MIT
/// Meshes cut into convex hulls: volumes against formulas, and hulls that are convex.
#include <cmath>
#include <numbers>
#include <sstream>

#include "reading.h"

namespace plumb::test {

namespace {

using std::numbers::pi;
const std::string kAt = "/bodies/0/shape/mesh";

std::string points_of(const std::vector<Eigen::Vector3d>& points) {
    std::ostringstream text;
    text.precision(17);
    text << '[';
    for (const auto& p : points)
        text << (text.tellp() > 1 ? ", [" : "[") << p.x() << ", " << p.y() << ", " << p.z() << "]";
    text << ']';
    return text.str();
}

std::string triangles_of(const std::vector<std::array<int, 3>>& triangles) {
    std::ostringstream text;
    text << '[';
    for (const auto& [a, b, c] : triangles)
        text << (text.tellp() > 1 ? ", [" : "[") << a << ", " << b << ", " << c << "]";
    text << ']';
    return text.str();
}

std::string mesh_of(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<std::array<int, 3>>& triangles,
                    const std::string& decompose) {
    return with_shape(R"({"mesh": {"vertices": )" + points_of(points) + R"(, "triangles": )" +
                      triangles_of(triangles) + R"(, "decompose": )" + decompose + "}}");
}

/// A torus about y of 36 × 16 quads, ring 0.5, tube 0.2.
std::string torus(const std::string& decompose) {
    constexpr int kRing = 36, kTube = 16;
    std::vector<Eigen::Vector3d> points;
    std::vector<std::array<int, 3>> triangles;
    for (int i = 0; i < kRing; ++i)
        for (int k = 0; k < kTube; ++k) {
            const double phi = 2 * pi * i / kRing, t = 2 * pi * k / kTube;
            const double rho = 0.5 + 0.2 * std::cos(t);
            points.emplace_back(rho * std::cos(phi), 0.2 * std::sin(t), rho * std::sin(phi));
            const int a = i * kTube + k, b = i * kTube + (k + 1) % kTube;
            const int c = (i + 1) % kRing * kTube + k,
                      d = (i + 1) % kRing * kTube + (k + 1) % kTube;
            triangles.push_back({a, b, c});
            triangles.push_back({c, b, d});
        }
    return mesh_of(points, triangles, decompose);
}

/// An L of three unit cubes, turned so that no face lies along an axis.
std::string letter_l(const std::string& decompose) {
    const std::array<Eigen::Vector2d, 6> outline = {
        {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
    const Eigen::Quaterniond turn = Eigen::Quaterniond(0.7, 0.3, -0.5, 0.2).normalized();
    std::vector<Eigen::Vector3d> points;
    for (const double z : {0.0, 1.0})
        for (const auto& p : outline) points.push_back(turn * Eigen::Vector3d(p.x(), p.y(), z));
    std::vector<std::array<int, 3>> triangles;
    for (const auto& [a, b, c] :
         std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
        triangles.push_back({a, c, b});
        triangles.push_back({a + 6, b + 6, c + 6});
    }
    for (int i = 0; i < 6; ++i) {
        const int k = (i + 1) % 6;
        triangles.push_back({i, k, i + 6});
        triangles.push_back({k, k + 6, i + 6});
    }
    return mesh_of(points, triangles, decompose);
}

Geometry shape_of(const std::string& scene) { return scene_of(scene).geometries.at(0); }

Eigen::Vector3d normal_of(const Geometry& hull, std::size_t face) {
    const auto& v = hull.vertices;
    const auto& f = hull.faces[face];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 2; i < f.size(); ++i)
        sum += (v[f[i - 1]] - v[f[0]]).cross(v[f[i]] - v[f[0]]);
    return sum.normalized();
}

bool contains(const Geometry& hull, const Eigen::Vector3d& p) {
    for (std::size_t i = 0; i < hull.faces.size(); ++i)
        if (normal_of(hull, i).dot(p - hull.vertices[hull.faces[i][0]]) > 0) return false;
    return true;
}

void expect_convex(const Geometry& compound) {
    for (const GeometryPart& part : compound.parts)
        for (std::size_t i = 0; i < part.geometry.faces.size(); ++i) {
            const Eigen::Vector3d n = normal_of(part.geometry, i);
            const Eigen::Vector3d& a = part.geometry.vertices[part.geometry.faces[i][0]];
            for (const auto& v : part.geometry.vertices) EXPECT_LT(n.dot(v - a), 1e-5);
        }
}

/// Volume of the union inside a box about the origin, by counting points of a lattice.
double union_volume(const Geometry& compound, const Eigen::Vector3d& half) {
    constexpr int kCount = 32;
    int inside = 0;
    for (int i = 0; i < kCount * kCount * kCount; ++i) {
        const Eigen::Vector3d share((i % kCount + 0.5) / kCount,
                                    (i / kCount % kCount + 0.5) / kCount,
                                    (i / kCount / kCount + 0.5) / kCount);
        const Eigen::Vector3d p = half.cwiseProduct(2 * share - Eigen::Vector3d::Ones());
        for (const GeometryPart& part : compound.parts)
            if (contains(part.geometry, p)) {
                ++inside;
                break;
            }
    }
    return 8 * half.prod() * inside / (kCount * kCount * kCount);
}

}  // namespace

TEST(Decompose, TorusIsFilledAndKeepsItsHole) {
    const Geometry g = shape_of(torus("true"));
    EXPECT_EQ(g.kind, ShapeKind::compound);
    EXPECT_GE(g.parts.size(), 6u);
    EXPECT_LE(g.parts.size(), 32u);
    expect_convex(g);
    const double exact = 2 * pi * pi * 0.5 * 0.2 * 0.2;
    EXPECT_NEAR(union_volume(g, {0.71, 0.21, 0.71}) / exact, 1, 0.1);
    for (const GeometryPart& part : g.parts)
        for (const double x : {0.0, 0.1, -0.15}) EXPECT_FALSE(contains(part.geometry, {x, 0, 0.1}));
    EXPECT_GT(g.concavity.value(), 0);
    EXPECT_LT(g.concavity.value(), 0.05);
}

TEST(Decompose, ALetterLIsTwoBoxes) {
    const Geometry g = shape_of(letter_l("true"));
    ASSERT_EQ(g.parts.size(), 2u);
    for (const GeometryPart& part : g.parts) {
        EXPECT_EQ(part.geometry.vertices.size(), 8u);
        EXPECT_EQ(part.geometry.faces.size(), 6u);
    }
    expect_convex(g);
    EXPECT_LT(g.concavity.value(), 1e-6);
}

TEST(Decompose, SmallerExcessTakesMorePartsAndIsTheSameEachTime) {
    const Geometry coarse = shape_of(torus(R"({"excess": 0.2})"));
    const Geometry fine = shape_of(torus(R"({"excess": 0.03, "max_parts": 64})"));
    EXPECT_LT(coarse.parts.size(), fine.parts.size());
    EXPECT_GT(coarse.concavity.value(), fine.concavity.value());
    EXPECT_EQ(shape_of(torus(R"({"max_parts": 3})")).parts.size(), 3u);

    const Geometry again = shape_of(torus(R"({"excess": 0.2})"));
    ASSERT_EQ(again.parts.size(), coarse.parts.size());
    for (std::size_t i = 0; i < again.parts.size(); ++i)
        EXPECT_EQ(again.parts[i].geometry.vertices, coarse.parts[i].geometry.vertices);
}

TEST(Decompose, RefusesOpenAndInsideOutMeshes) {
    const std::vector<Eigen::Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    expect_error(mesh_of(corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}}, "true"), kAt + "/decompose",
                 "not closed");
    expect_error(mesh_of(corners, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, "true"),
                 kAt + "/decompose", "inside out");
    expect_error(letter_l("3"), kAt + "/decompose", "true, false or an object");
    expect_error(letter_l(R"({"exess": 1})"), kAt + "/decompose/exess", "did you mean \"excess\"?");
    EXPECT_EQ(shape_of(letter_l("false")).kind, ShapeKind::mesh);
}

}  // namespace plumb::test
