// SPDX-License-Identifier: MIT
#include "output/png.h"

#include "falling.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

namespace plumb::test {
namespace {

constexpr PictureSettings kSmall{320, 240, 8, 2};

/// One ball, or none, in the middle of a picture without ground.
Picture ball_picture(double radius, double distance, double field_of_view,
                     const PictureSettings& settings, bool there = true) {
    Scene scene;
    scene.geometries = {sphere(radius)};
    BodySpec body;
    body.geometry = there ? 0 : kNoIndex;
    body.color = 0xd01010;
    scene.bodies = {body};
    scene.view = View{{0.6 * distance, 0, 0.8 * distance}, {0, 0, 0}, field_of_view};
    Frame frame;
    frame.bodies.resize(1);
    return draw_picture(recording_header(scene, {}), frame, settings);
}

int byte_at(const Picture& picture, std::size_t pixel, std::size_t channel) {
    return picture.rgb[3 * pixel + channel];
}

TEST(PictureTest, SilhouetteOfABallHasTheProjectedArea) {
    const double radius = 1, distance = 4, field_of_view = 50;
    const PictureSettings settings{480, 360, 8, 2};
    const Picture with = ball_picture(radius, distance, field_of_view, settings);
    const Picture without = ball_picture(radius, distance, field_of_view, settings, false);
    // The ball has little green and the sky much, so that a pixel counts when the ball fills half
    // of it or more.
    double area = 0;
    for (std::size_t i = 0; i < with.rgb.size() / 3; ++i) {
        const int difference = std::abs(byte_at(with, i, 1) - byte_at(without, i, 1));
        area += difference > 60 ? 1 : 0;
    }
    const double focus =
        0.5 * settings.height / std::tan(0.5 * field_of_view * std::numbers::pi / 180);
    const double rim = focus * radius / std::sqrt(distance * distance - radius * radius);
    EXPECT_NEAR(area / (std::numbers::pi * rim * rim), 1, 0.02);
}

TEST(PictureTest, LightComesFromAbove) {
    const Picture picture = ball_picture(1, 4, 50, kSmall);
    const auto brightness = [&picture](int y) {
        const std::size_t pixel = static_cast<std::size_t>(y * picture.width + picture.width / 2);
        return byte_at(picture, pixel, 0) + byte_at(picture, pixel, 1) + byte_at(picture, pixel, 2);
    };
    EXPECT_GT(brightness(kSmall.height / 2 - 40), brightness(kSmall.height / 2 + 45) + 30);
}

TEST(PictureTest, EveryShapeIsSeen) {
    const Scene all = falling_scene(9);
    for (std::size_t k = 0; k < all.geometries.size(); ++k) {
        Scene scene;
        scene.geometries = {all.geometries[k]};
        BodySpec body;
        body.geometry = 0;
        body.color = 0xd01010;
        scene.bodies = {body};
        scene.view = View{{0.5, 1.5, 2}, {0, 0, 0}, 40};
        Frame frame;
        frame.bodies.resize(1);
        const Picture with = draw_picture(recording_header(scene, {}), frame, kSmall);
        scene.bodies[0].geometry = kNoIndex;
        const Picture without = draw_picture(recording_header(scene, {}), frame, kSmall);
        std::size_t different = 0;
        for (std::size_t i = 0; i < with.rgb.size(); ++i)
            different += with.rgb[i] != without.rgb[i];
        EXPECT_GT(different, with.rgb.size() / 50) << name_of(all.geometries[k].kind);
    }
}

TEST(PictureTest, IsTheSameOnOneAndThreeThreads) {
    const Scene scene = falling_scene(30);
    const RecordingHeader header = recording_header(scene, {});
    const Frame frame = falling_frame(scene, 0, 0.4);
    const Picture one = draw_picture(header, frame, {160, 90, 4, 1});
    const Picture three = draw_picture(header, frame, {160, 90, 4, 3});
    EXPECT_EQ(one.rgb, three.rgb);
    EXPECT_GT(std::set<std::uint8_t>(one.rgb.begin(), one.rgb.end()).size(), 100u);
}

TEST(PictureTest, BodyThatIsNotFiniteIsLeftOut) {
    const Scene scene = falling_scene(3);
    Frame frame = falling_frame(scene, 0, 0.4);
    frame.bodies[2].placement.position.setConstant(std::nan(""));
    frame.bodies[3].placement.rotation.coeffs().setConstant(std::nan(""));
    const Picture picture = draw_picture(recording_header(scene, {}), frame, {64, 36, 2, 1});
    EXPECT_EQ(picture.rgb.size(), 64u * 36u * 3u);
}

TEST(PngTest, HeaderSaysTheSize) {
    const std::string bytes = png_bytes(ball_picture(1, 4, 50, kSmall));
    ASSERT_GT(bytes.size(), 1000u);
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    const auto number = [&bytes](std::size_t at) {
        return static_cast<unsigned char>(bytes[at + 2]) * 256 +
               static_cast<unsigned char>(bytes[at + 3]);
    };
    EXPECT_EQ(number(16), 320);
    EXPECT_EQ(number(20), 240);
}

}  // namespace
}  // namespace plumb::test
