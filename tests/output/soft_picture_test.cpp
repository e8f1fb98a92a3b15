// SPDX-License-Identifier: MIT
#include "output/picture.h"

#include "geometry/outer_faces.h"
#include "output/smooth_surface.h"
#include "output/view.h"
#include "soft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plumb::test {
namespace {

constexpr PictureSettings kSmall{480, 360, 8, 2};
constexpr double kDistance = 4, kAngle = 50;

Scene scene_of(DeformableSpec spec, const Eigen::Vector3d& eye) {
    Scene scene;
    spec.color = 0xd01010;
    scene.deformables = {std::move(spec)};
    scene.view = View{eye, {0, 0, 0}, kAngle};
    return scene;
}

/// Pixels per length at a distance of 1 m, over that.
double focus() { return 0.5 * kSmall.height / std::tan(0.5 * kAngle * std::numbers::pi / 180); }

/// How many pixels the scene's deformables fill. They have little green and the sky has much.
double pixels_of(const Scene& scene) {
    const RecordingHeader header = recording_header(scene, {});
    Scene bare = scene;
    bare.deformables.clear();
    const Picture with = draw_picture(header, soft_frame(scene, 0, 0), kSmall);
    const Picture without =
        draw_picture(recording_header(bare, {}), soft_frame(bare, 0, 0), kSmall);
    double count = 0;
    for (std::size_t i = 1; i < with.rgb.size(); i += 3)
        count += std::abs(with.rgb[i] - without.rgb[i]) > 60;
    return count;
}

TEST(SoftPicture, BalloonThatIsABallHasTheProjectedAreaOfOne) {
    const double radius = 1;
    const double area =
        pixels_of(scene_of(balloon(4, radius), {0.6 * kDistance, 0, 0.8 * kDistance}));
    const double rim = focus() * radius / std::sqrt(kDistance * kDistance - radius * radius);
    EXPECT_NEAR(area / (std::numbers::pi * rim * rim), 1, 0.02);
}

TEST(SoftPicture, SheetIsSeenFromBothSides) {
    const double side = 1.5, seen = focus() * side / kDistance;
    for (const double height : {kDistance, -kDistance}) {
        Scene scene = scene_of(sheet(11, side), {0, height, 0});
        scene.settings.gravity = {0, 0, -9.81};
        EXPECT_NEAR(pixels_of(scene) / (seen * seen), 1, 0.03) << height;
    }
}

TEST(SoftPicture, RopeIsAsThickAsItIs) {
    const double length = 2, diameter = 0.12;
    const double scale = focus() / kDistance;
    const double area = pixels_of(scene_of(rope(20, length, diameter), {0, 0, kDistance}));
    const double ends = std::numbers::pi / 4 * diameter * diameter;
    EXPECT_NEAR(area / (scale * scale * (length * diameter + ends)), 1, 0.05);
}

/// A hair of a rope is drawn so wide that it can be seen.
TEST(SoftPicture, ThinRopeIsSeen) {
    EXPECT_GT(pixels_of(scene_of(rope(20, 2, 1e-5), {0, 0, kDistance})), 2 * focus() / kDistance);
}

TEST(SoftPicture, PointThatIsNotFiniteTakesItsTrianglesAlone) {
    const Scene scene = scene_of(balloon(3, 1), {0, 0, kDistance});
    const RecordingHeader header = recording_header(scene, {});
    Frame frame = soft_frame(scene, 0, 0);
    frame.particles[0].setConstant(std::nan(""));
    const auto surface = surface_of(header.deformables[0], frame, Eigen::Vector3d::Zero());
    ASSERT_TRUE(surface.has_value());
    EXPECT_EQ(surface->mesh().triangles.size(), scene.deformables[0].triangles.size() - 4);
    EXPECT_FALSE(draw_picture(header, frame, {64, 48, 2, 1}).rgb.empty());
}

/// What is torn is left out of a sheet and a rope; a solid shows what its tear lays open.
TEST(SoftPicture, WhatIsTornIsLeftOut) {
    Scene scene = scene_of(sheet(11, 1), {0, 0, kDistance});
    scene.deformables.push_back(rope(10, 2, 0.12));
    scene.deformables.push_back(jelly(2, 0.6));
    for (DeformableSpec& spec : scene.deformables) spec.tearing_strain = 0.5;
    const RecordingHeader header = recording_header(scene, {});
    const auto& deformables = header.deformables;
    Frame frame = soft_frame(scene, 0, 0);
    const auto triangles = [&](std::size_t i) {
        return surface_of(deformables[i], frame, Eigen::Vector3d::Zero())->mesh().triangles;
    };
    EXPECT_EQ(triangles(0).size(), 200u);
    const auto closed = triangles(2);
    frame.torn = {{0, 7}, {0, 30}, {1, 5}, {2, 0}};
    EXPECT_EQ(triangles(0).size(), 198u);
    EXPECT_EQ(triangles(0)[7], scene.deformables[0].triangles[8]);
    EXPECT_EQ(segments_in(deformables[1], frame).size(), 9u);
    EXPECT_EQ(segments_in(deformables[1], frame)[5], scene.deformables[1].segments[6]);
    auto left = scene.deformables[2].tetrahedra;
    left.erase(left.begin());
    EXPECT_EQ(triangles(2), outer_faces(left));
    EXPECT_NE(triangles(2), closed);
}

/// On a ball, blended normals are almost those of the ball. Rays start above it, by little more
/// than the triangles lie below it.
TEST(SmoothSurfaceTest, OfABallIsRound) {
    const Scene scene = scene_of(balloon(3, 1), {0, 0, kDistance});
    const auto surface = surface_of(recording_header(scene, {}).deformables[0],
                                    soft_frame(scene, 0, 0), Eigen::Vector3d::Zero());
    ASSERT_TRUE(surface.has_value());
    const TriangleMesh& mesh = surface->mesh();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Eigen::Vector3f flat =
            (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0f;
        const auto outside = surface->look({t, 1.0f / 3, 1.0f / 3}, -flat);
        EXPECT_GT(outside.normal.dot(flat.normalized()), std::cos(0.04));
        EXPECT_GT(outside.rounded.norm(), 1);
        EXPECT_LT(outside.rounded.norm() - 1, 1.3f * (1 - flat.norm()));
        const auto inside = surface->look({t, 1.0f / 3, 1.0f / 3}, flat);
        EXPECT_LT(inside.normal.dot(flat.normalized()), -std::cos(0.04));
        EXPECT_LT(inside.rounded.norm(), flat.norm() + 1e-6f);
    }
}

/// The sides of a cube stay flat up to its edges.
TEST(SmoothSurfaceTest, OfASolidKeepsItsEdges) {
    const Scene scene = scene_of(jelly(3, 1), {0, 0, kDistance});
    const auto surface = surface_of(recording_header(scene, {}).deformables[0],
                                    soft_frame(scene, 0, 0), Eigen::Vector3d::Zero());
    ASSERT_TRUE(surface.has_value());
    for (std::uint32_t t = 0; t < surface->mesh().triangles.size(); ++t) {
        for (const auto& [u, v] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}})
            EXPECT_NEAR(surface->look({t, u, v}, {0.1f, 0.2f, 0.3f}).normal.cwiseAbs().maxCoeff(),
                        1, 1e-6);
    }
}

/// Whether a place is within the picture of a view.
bool in_picture(const View& view, const Eigen::Vector3d& place, double aspect) {
    const Eigen::Vector3d back = (view.eye - view.target).normalized();
    const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(back).normalized();
    const Eigen::Vector3d p = place - view.eye;
    const double reach = -p.dot(back) * std::tan(0.5 * view.field_of_view * std::numbers::pi / 180);
    return reach > 0 && std::abs(p.dot(right)) < reach * aspect &&
           std::abs(p.dot(back.cross(right))) < reach;
}

TEST(SoftView, HoldsAllPointsAndBodiesBesideThem) {
    const Scene scene = soft_scene(3);
    const RecordingHeader header = recording_header(scene, {});
    Frame frame = soft_frame(scene, 0, 0.3);
    const auto fitted = [&] {
        return fitted_view(balls_of_interest(header, frame), Eigen::Vector3d::UnitY(), 1.5);
    };
    const View view = fitted();
    for (const Eigen::Vector3d& place : frame.particles)
        EXPECT_TRUE(in_picture(view, place, 1.5)) << place.transpose();
    EXPECT_TRUE(in_picture(view, frame.bodies[0].placement.position, 1.5));
    EXPECT_LT((view.eye - view.target).norm(), 20);

    frame.particles[5] = {1e5, -1e5, 0};  // torn off, and gone
    frame.particles[6].setConstant(std::nan(""));
    EXPECT_LT((fitted().eye - view.eye).norm(), 1);
}

}  // namespace
}  // namespace plumb::test
