// SPDX-License-Identifier: MIT
/// The replay is taken apart here with nothing but the text of motion_code.h, as the player does
/// it.
#include "output/html.h"

#include "falling.h"
#include "output/palette.h"
#include "output/player.h"
#include "page.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>

#include <random>

namespace plumb::test {
namespace {

/// Poses of the moving bodies as a page carries them.
class Replay {
public:
    explicit Replay(const std::string& page)
        : scene(nlohmann::json::parse(element(page, "plumb-scene"))),
          bodies(scene["moving"].size()),
          frames(scene["frames"]["time"].size()),
          bytes_(inflated(from_base64(element(page, "plumb-motion")), 13 * bodies * frames)) {
        for (std::size_t channel = 0; channel < 6; ++channel) undo(channel);
    }

    Placement pose(std::size_t index, std::size_t frame) const {
        const std::size_t k = index * frames + frame;
        const nlohmann::json& moving = scene["moving"][index];
        Placement placement;
        for (std::size_t i = 0; i < 3; ++i) {
            placement.position[static_cast<Eigen::Index>(i)] =
                moving["low"][i].get<double>() + moving["quantum"].get<double>() * values_[i][k];
        }
        RotationCode code{{values_[3][k], values_[4][k], values_[5][k]}, 0};
        for (std::size_t f = 0; f <= frame; ++f)
            code.largest += byte(12 * bodies * frames + index * frames + f);
        placement.rotation = decode_rotation(code, scene["rotation_bits"].get<int>());
        return placement;
    }

    nlohmann::json scene;
    std::size_t bodies, frames;

private:
    unsigned byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }

    void undo(std::size_t channel) {
        const std::size_t count = bodies * frames;
        for (std::size_t k = 0; k < count; ++k) {
            const unsigned code =
                byte(2 * channel * count + k) | (byte((2 * channel + 1) * count + k) << 8);
            const unsigned difference = code & 1 ? ~(code >> 1) : code >> 1;
            const unsigned previous = k % frames > 0 ? values_[channel][k - 1] : 0;
            const unsigned before = k % frames > 1 ? values_[channel][k - 2] : 0;
            values_[channel].push_back((difference + 2 * previous - before) & 0xffffu);
        }
    }

    std::string bytes_;
    std::vector<unsigned> values_[6];
};

class HtmlTest : public TemporaryFolder {
protected:
    std::string page(const Scene& scene, const std::vector<Frame>& frames,
                     const Metadata& metadata = {}) {
        HtmlExporter exporter(path("run.html"), recording_header(scene, metadata));
        for (const Frame& frame : frames) exporter.append(frame);
        exporter.finish();
        return read_file(path("run.html"));
    }
};

std::vector<Frame> falling_frames(const Scene& scene, int count) {
    std::vector<Frame> frames;
    for (int i = 0; i < count; ++i) {
        frames.push_back(falling_frame(scene, static_cast<std::uint64_t>(i), i / 30.0));
    }
    return frames;
}

TEST_F(HtmlTest, PosesComeBackWithinTheFormatsBounds) {
    const Scene scene = falling_scene(30);
    const std::vector<Frame> frames = falling_frames(scene, 60);
    const Replay replay(page(scene, frames));
    const Eigen::Vector3d origin = recording_header(scene, {}).origin;
    ASSERT_EQ(replay.bodies, 30u);
    ASSERT_EQ(replay.frames, 60u);
    for (std::size_t index = 0; index < replay.bodies; ++index) {
        const auto body = replay.scene["moving"][index]["body"].get<std::size_t>();
        const double quantum = replay.scene["moving"][index]["quantum"];
        EXPECT_LT(quantum, 1e-3);
        for (std::size_t f = 0; f < frames.size(); ++f) {
            const Placement& wanted = frames[f].bodies[body].placement;
            const Placement got = replay.pose(index, f);
            EXPECT_LE((got.position + origin - wanted.position).cwiseAbs().maxCoeff(),
                      0.5 * quantum + 1e-5);
            EXPECT_LE(got.rotation.angularDistance(wanted.rotation),
                      rotation_error_bound(kReplayRotationBits));
        }
    }
}

TEST_F(HtmlTest, NumbersOfTheFramesAndBodiesAtRestAreInThePage) {
    const Scene scene = falling_scene(3);
    const std::vector<Frame> frames = falling_frames(scene, 4);
    const Replay replay(page(scene, frames, {"fcl", {}}));
    EXPECT_EQ(replay.scene["collider"], "fcl");
    EXPECT_EQ(replay.scene["frames"]["time"][3], frames[3].time);
    EXPECT_EQ(replay.scene["frames"]["contacts"][3], frames[3].contacts);
    EXPECT_EQ(replay.scene["frames"]["kinetic"][3], frames[3].kinetic_energy);
    EXPECT_EQ(replay.scene["frames"]["penetration"][3], frames[3].deepest_penetration);
    const nlohmann::json& residual = replay.scene["frames"]["residual"];
    EXPECT_EQ(residual["force_of_weight"][3], frames[3].residual.force_of_weight);
    EXPECT_EQ(residual["force"][3], frames[3].residual.force);
    EXPECT_EQ(residual["error"][3], frames[3].residual.error);
    EXPECT_NEAR(replay.scene["bodies"][1]["pose"][0].get<double>(), -7.5, 1e-6);
    EXPECT_FALSE(replay.scene["bodies"][2].contains("pose"));
    EXPECT_EQ(replay.scene["bodies"][2]["color"], body_color({}, 2));
}

TEST_F(HtmlTest, ResidualsThatNobodyToldAreNullAndOldRecordingsHaveNone) {
    const Scene scene = falling_scene(1);
    std::vector<Frame> frames = falling_frames(scene, 2);
    frames[0].residual = {};
    const nlohmann::json told = Replay(page(scene, frames)).scene["frames"]["residual"];
    for (const char* key : {"force_of_weight", "force", "error"}) {
        EXPECT_TRUE(told[key][0].is_null()) << key;
        EXPECT_GT(told[key][1].get<double>(), 0) << key;
    }
    RecordingHeader old = recording_header(scene, {});
    old.residuals = false;
    export_recording(path("old.html"), {old, frames, 0});
    EXPECT_FALSE(Replay(read_file(path("old.html"))).scene["frames"].contains("residual"));
}

TEST_F(HtmlTest, PageAsksForNothingFromOutside) {
    const Scene scene = falling_scene(2);
    std::string text = page(scene, falling_frames(scene, 2));
    EXPECT_NE(text.find("content=\"default-src 'none'; script-src 'unsafe-inline'"),
              std::string::npos);
    // The one address is the name of a vocabulary, which nobody fetches.
    const std::string vocabulary = "http://www.w3.org/1999/xhtml";
    for (std::size_t at; (at = text.find(vocabulary)) != std::string::npos;)
        text.erase(at, vocabulary.size());
    for (const char* forbidden :
         {"http://", "https://", " src=", " href=", "fetch(", "XMLHttpRequest", "import("}) {
        EXPECT_EQ(text.find(forbidden), std::string::npos) << forbidden;
    }
}

TEST_F(HtmlTest, NamesCannotBreakOutOfThePage) {
    const std::string evil = "</script><script>alert(1)</script><!-- & \" \xff";
    Scene scene = falling_scene(2);
    const auto scripts = [this](const Scene& s) {
        const std::string text = page(s, falling_frames(s, 2), {s.name, {{s.name, s.name}}});
        std::size_t count = 0;
        for (std::size_t at = 0; (at = text.find("<script", at)) != std::string::npos; ++at)
            ++count;
        EXPECT_EQ(text.find("alert(1)</script>"), std::string::npos);
        return count;
    };
    const std::size_t usual = scripts(scene);
    scene.name = scene.description = scene.bodies[0].name = scene.geometries[0].name = evil;
    EXPECT_EQ(scripts(scene), usual);
    const Replay replay(read_file(path("run.html")));
    EXPECT_EQ(replay.scene["name"].get<std::string>().substr(0, evil.size() - 1),
              evil.substr(0, evil.size() - 1));
    EXPECT_EQ(player_script().find("</script"), std::string_view::npos);
}

TEST_F(HtmlTest, BodyThatFliesAwayDoesNotBlurTheOthers) {
    const Scene scene = falling_scene(3);
    std::vector<Frame> frames = falling_frames(scene, 10);
    for (std::size_t f = 0; f < 10; ++f)
        frames[f].bodies[2].placement.position.x() = 1e7 * static_cast<double>(f);
    frames[9].bodies[2].placement.position.x() = std::numeric_limits<double>::infinity();
    frames[9].bodies[2].placement.rotation.coeffs().setConstant(std::nan(""));
    const Replay replay(page(scene, frames));
    EXPECT_LT(replay.scene["moving"][1]["quantum"].get<double>(), 1e-3);
    const Eigen::Vector3d wanted =
        frames[9].bodies[3].placement.position - recording_header(scene, {}).origin;
    EXPECT_LT((replay.pose(1, 9).position - wanted).norm(), 1e-3);
}

TEST_F(HtmlTest, TwoThousandRestlessBodiesStayBelowFifteenMegabytes) {
    const Scene scene = falling_scene(2000);
    std::mt19937 random(1);
    std::normal_distribution<double> shake;
    std::vector<Frame> frames = falling_frames(scene, 300);
    for (Frame& frame : frames) {
        for (BodyState& body : frame.bodies) {
            for (Eigen::Index i = 0; i < 3; ++i) body.placement.position[i] += 2e-3 * shake(random);
            const Eigen::Vector3d axis(shake(random), shake(random), shake(random));
            body.placement.rotation =
                Eigen::AngleAxisd(0.01, axis.normalized()) * body.placement.rotation;
        }
    }
    EXPECT_LT(page(scene, frames).size(), 15'000'000u);
}

}  // namespace
}  // namespace plumb::test
