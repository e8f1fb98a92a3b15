// SPDX-License-Identifier: MIT
/// Deformables of a replay, taken apart with nothing but the text of particle_motion.h.
#include "output/html.h"

#include "page.h"
#include "soft.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <random>

namespace plumb::test {
namespace {

/// Places of the points as a page carries them.
class SoftReplay {
public:
    explicit SoftReplay(const std::string& page)
        : scene(nlohmann::json::parse(element(page, "plumb-scene"))),
          frames_(scene["frames"]["time"].size()) {
        std::size_t points = 0;
        for (const auto& d : scene["deformables"]) points += d["count"].get<std::size_t>();
        bytes_ = inflated(from_base64(element(page, "plumb-particles")), 6 * points * frames_);
        for (const auto& d : scene["deformables"])
            for (int axis = 0; axis < 3; ++axis) undo(d["count"]);
    }

    Eigen::Vector3d place(std::size_t deformable, std::size_t point, std::size_t frame) const {
        const nlohmann::json& d = scene["deformables"][deformable];
        Eigen::Vector3d place;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t base =
                d.contains("bases") ? d["bases"][frame][axis].get<std::int64_t>() : 0;
            const std::int64_t bits = values_[3 * deformable + axis][point * frames_ + frame];
            const std::int64_t integer = base + ((bits - base) & 0xffff);
            place[static_cast<Eigen::Index>(axis)] =
                d["low"][axis].get<double>() +
                d["quantum"].get<double>() * static_cast<double>(integer);
        }
        return place;
    }

    nlohmann::json scene;

private:
    void undo(std::size_t points) {
        const std::size_t count = points * frames_;
        std::vector<unsigned> values, differences;
        for (std::size_t k = 0; k < count; ++k) {
            const auto byte = [&](std::size_t at) {
                return static_cast<unsigned char>(bytes_[at]);
            };
            const unsigned code = byte(at_ + k) | (byte(at_ + count + k) << 8);
            const unsigned before_it = k >= frames_ ? differences[k - frames_] : 0;
            differences.push_back((code & 1 ? ~(code >> 1) : code >> 1) + before_it);
            const unsigned previous = k % frames_ > 0 ? values[k - 1] : 0;
            const unsigned before = k % frames_ > 1 ? values[k - 2] : 0;
            values.push_back((differences[k] + 2 * previous - before) & 0xffffu);
        }
        values_.push_back(values);
        at_ += 2 * count;
    }

    std::size_t frames_, at_ = 0;
    std::string bytes_;
    std::vector<std::vector<unsigned>> values_;  // [3 × deformable + axis][point × frames + frame]
};

class SoftHtmlTest : public TemporaryFolder {
protected:
    std::string page(const Scene& scene, const std::vector<Frame>& frames) {
        HtmlExporter exporter(path("run.html"), recording_header(scene, {}));
        for (const Frame& frame : frames) exporter.append(frame);
        exporter.finish();
        return read_file(path("run.html"));
    }

    void expect_places(const Scene& scene, const std::vector<Frame>& frames, double slack) {
        const SoftReplay replay(page(scene, frames));
        const RecordingHeader header = recording_header(scene, {});
        for (std::size_t d = 0; d < header.deformables.size(); ++d) {
            const double quantum = replay.scene["deformables"][d]["quantum"];
            for (std::size_t f = 0; f < frames.size(); ++f) {
                for (std::uint32_t i = 0; i < header.deformables[d].count; ++i) {
                    const Eigen::Vector3d wanted =
                        frames[f].particles[header.deformables[d].first + i] - header.origin;
                    EXPECT_LE((replay.place(d, i, f) - wanted).cwiseAbs().maxCoeff(),
                              0.5 * quantum + slack);
                }
            }
        }
    }
};

std::vector<Frame> soft_frames(const Scene& scene, int count) {
    std::vector<Frame> frames;
    for (int i = 0; i < count; ++i)
        frames.push_back(soft_frame(scene, static_cast<std::uint64_t>(i), i / 30.0));
    return frames;
}

TEST_F(SoftHtmlTest, PlacesComeBackWithinTheFormatsBounds) {
    const Scene scene = soft_scene(3);
    expect_places(scene, soft_frames(scene, 20), 1e-6);
}

/// However far it flies, its shape stays as fine: an edge turns by no more than 1/400.
TEST_F(SoftHtmlTest, WhatFliesFarKeepsItsShape) {
    const Scene scene = soft_scene(3);
    std::vector<Frame> frames = soft_frames(scene, 12);
    for (std::size_t f = 0; f < frames.size(); ++f)
        for (Eigen::Vector3d& place : frames[f].particles)
            place.x() += 40.0 * static_cast<double>(f);
    expect_places(scene, frames, 4e-5);  // of a float, 440 m from the origin
    const SoftReplay replay(read_file(path("run.html")));
    EXPECT_EQ(replay.scene["deformables"][1]["bases"].size(), frames.size());
    EXPECT_LT(replay.scene["deformables"][1]["quantum"].get<double>(), 1e-3);
}

TEST_F(SoftHtmlTest, PlaceThatIsNotFiniteDoesNotHurtTheOthers) {
    const Scene scene = soft_scene(2);
    std::vector<Frame> frames = soft_frames(scene, 4);
    frames[2].particles[7].setConstant(std::nan(""));
    const SoftReplay replay(page(scene, frames));
    const Eigen::Vector3d wanted = frames[2].particles[8] - recording_header(scene, {}).origin;
    EXPECT_LT((replay.place(0, 8, 2) - wanted).norm(), 1e-3);
    EXPECT_TRUE(replay.place(0, 7, 2).allFinite());
}

/// Each element with the first frame that shows it and the one after the last.
TEST_F(SoftHtmlTest, WhatTearsIsShownUntilThen) {
    Scene scene = soft_scene(2);
    for (DeformableSpec& spec : scene.deformables) spec.tearing_strain = 0.5;
    std::vector<Frame> frames = soft_frames(scene, 5);
    for (std::size_t f = 2; f < 5; ++f) frames[f].torn = {{0, 3}, {2, 1}};
    for (std::size_t f = 3; f < 5; ++f) frames[f].torn = {{0, 3}, {2, 1}, {3, 6}};
    const SoftReplay replay(page(scene, frames));
    const nlohmann::json& list = replay.scene["deformables"];
    using Shown = std::vector<std::array<std::size_t, 2>>;
    Shown sheet(scene.deformables[0].triangles.size(), {0, 5}), rope(20, {0, 5});
    sheet[3] = {0, 2}, rope[6] = {0, 3};
    EXPECT_EQ(list[0]["shown"].get<Shown>(), sheet);
    EXPECT_FALSE(list[1].contains("shown")) << "it did not tear";
    EXPECT_EQ(list[3]["shown"].get<Shown>(), rope);
    // a tetrahedron's faces are gone where they were outside, and its neighbours' are there now
    const Shown solid = list[2]["shown"].get<Shown>();
    EXPECT_EQ(list[2]["mesh"]["triangles"], solid.size());
    const auto gone = std::count(solid.begin(), solid.end(), std::array<std::size_t, 2>{0, 2}),
               bared = std::count(solid.begin(), solid.end(), std::array<std::size_t, 2>{2, 5});
    EXPECT_EQ(gone + bared, 4);
    EXPECT_EQ(solid.size(), 48u + static_cast<std::size_t>(bared));
}

TEST_F(SoftHtmlTest, PageSaysWhatThePlayerDraws) {
    const Scene scene = soft_scene(2);
    const SoftReplay replay(page(scene, soft_frames(scene, 2)));
    const nlohmann::json& list = replay.scene["deformables"];
    ASSERT_EQ(list.size(), 4u);
    std::size_t first = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(list[i]["name"], scene.deformables[i].name);
        EXPECT_EQ(list[i]["first"], first);
        first += scene.deformables[i].points.size();
        EXPECT_EQ(list[i].contains("mesh"), i < 3);
        EXPECT_EQ(list[i].contains("segments"), i == 3);
    }
    EXPECT_EQ(list[0]["kind"], "cloth");
    EXPECT_EQ(list[0]["mesh"]["triangles"], scene.deformables[0].triangles.size());
    EXPECT_EQ(list[2]["mesh"]["triangles"], 48);
    EXPECT_EQ(list[3]["radius"], 0.015);
    EXPECT_EQ(list[3]["segments"].size(), 20u);

    const std::size_t triangles =
        scene.deformables[0].triangles.size() + scene.deformables[1].triangles.size() + 48;
    const std::string meshes =
        inflated(from_base64(element(read_file(path("run.html")), "plumb-meshes")), 12 * triangles);
    EXPECT_EQ(meshes[12 + 4], static_cast<char>(scene.deformables[0].triangles[1][1]));

    ASSERT_EQ(replay.scene["links"].size(), 2u);
    EXPECT_EQ(replay.scene["links"][0][0]["body"], 0);
    EXPECT_EQ(replay.scene["links"][0][1]["particle"], scene.deformables[0].points.size() + 2);
    EXPECT_FALSE(replay.scene["links"][1][0].contains("body"));
}

/// A wave runs through a sheet of 41 × 41 points; what rests takes next to nothing.
TEST_F(SoftHtmlTest, APointTakesAboutAByteAFrame) {
    Scene scene;
    scene.deformables = {sheet(41, 2)};
    const double points = 41 * 41, frames = 100;
    const auto empty = static_cast<double>(page(scene, {}).size());
    const auto moved = static_cast<double>(page(scene, soft_frames(scene, 100)).size());
    EXPECT_LT((moved - empty) / (points * frames), 1.5);
    const std::vector<Frame> still(100, soft_frame(scene, 0, 0.1));
    EXPECT_LT((static_cast<double>(page(scene, still).size()) - empty) / (points * frames), 0.1);
}

}  // namespace
}  // namespace plumb::test
