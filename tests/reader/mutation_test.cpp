// SPDX-License-Identifier: MIT
/// Whatever the text, the reader returns a scene or throws a SceneError: valid scenes, damaged at
/// random.
#include <cmath>
#include <fstream>
#include <sstream>

#include "math/random.h"
#include "reading.h"
#include "scene/deformable_faults.h"
#include "scene/link_faults.h"

namespace plumb::test {

namespace {

using plumb::Random;

std::string text_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

const std::vector<std::string>& fragments() {
    static const std::vector<std::string> list = {"null",
                                                  "-1",
                                                  "0",
                                                  "1e308",
                                                  "-1e308",
                                                  "1e999",
                                                  "NaN",
                                                  "1e-320",
                                                  "\"\"",
                                                  "[]",
                                                  "{}",
                                                  "true",
                                                  "[0,0,0]",
                                                  "\"ball\"",
                                                  "{\"plane\":{}}",
                                                  "4294967296",
                                                  "18446744073709551616",
                                                  "{",
                                                  "}",
                                                  "[",
                                                  "]",
                                                  ",",
                                                  ":",
                                                  "\"",
                                                  "/*",
                                                  "//",
                                                  "\\u0000",
                                                  "\xff",
                                                  "\"repeat\":",
                                                  "\"obj\":\"meshes/gem.obj\"",
                                                  "\"repeat\":{\"count\":[9999,9999,9999]},",
                                                  "\"mesh\":{\"file\":\"meshes/duck.obj\"}"};
    return list;
}

/// Changes a text in one place: drops, doubles or replaces a stretch of it.
void damage(std::string& text, Random& random) {
    const std::size_t at = random.below(text.size() + 1);
    const std::size_t length = std::min(random.below(12), text.size() - at);
    switch (random.below(5)) {
        case 0:
            text.erase(at, length);
            break;
        case 1:
            text.insert(at, text.substr(at, length));
            break;
        case 2:
            text.insert(at, fragments()[random.below(fragments().size())]);
            break;
        case 3:
            text.replace(at, length, fragments()[random.below(fragments().size())]);
            break;
        default:
            text.insert(at, 1, static_cast<char>(random.below(256)));
    }
}

/// Replaces one number or word of a text, which leaves most of it good JSON.
void replace_value(std::string& text, Random& random) {
    const std::string starts = "-0123456789tf";
    std::size_t at = text.find_first_of(starts, random.below(text.size()));
    if (at == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_of(",]} \n", at), text.size());
    text.replace(at, end - at, fragments()[random.below(fragments().size())]);
}

/// All values of a scene that a solver would compute with are finite.
bool finite(const Scene& scene) {
    bool good = std::isfinite(scene.settings.dt) && scene.settings.gravity.allFinite();
    for (const BodySpec& body : scene.bodies) {
        good = good && body.placement.position.allFinite() && body.velocity.allFinite() &&
               std::abs(body.placement.rotation.norm() - 1) < 1e-9;
    }
    for (const JointSpec& joint : scene.joints) {
        good = good && joint.anchor.allFinite() && std::abs(joint.frame.norm() - 1) < 1e-9;
        for (const JointAxisSpec& axis : joint.axes)
            good = good && axis.lower <= axis.upper &&
                   std::isfinite(axis.motor.target + axis.stiffness + axis.rest + axis.friction);
    }
    for (const CouplingSpec& coupling : scene.couplings)
        good = good && std::isfinite(coupling.ratio) && coupling.ratio != 0;
    for (const Geometry& geometry : scene.geometries) {
        for (const auto& vertex : geometry.vertices) good = good && vertex.allFinite();
    }
    return good;
}

/// Nothing is wrong with what deforms, by the faults that programs are asked about.
bool sound(const Scene& scene) {
    for (const DeformableSpec& d : scene.deformables)
        if (deformable_fault(d, scene.materials.size())) return false;
    for (const LinkSpec& link : scene.links)
        if (link_fault(scene, link)) return false;
    for (const AttachmentSpec& attachment : scene.attachments)
        if (attachment_fault(scene, attachment)) return false;
    return true;
}

struct Tally {
    int scenes = 0, errors = 0;
};

void expect_scene_or_error(const std::string& text, Tally& tally) {
    try {
        const Scene scene = scene_of(text);
        EXPECT_TRUE(finite(scene) && sound(scene)) << text;
        ++tally.scenes;
    } catch (const SceneError& error) {
        EXPECT_GT(std::string(error.what()).size(), error.file().size() + 10) << text;
        ++tally.errors;
    } catch (const std::exception& error) {
        FAIL() << "not a SceneError: " << error.what() << "\n" << text;
    }
}

}  // namespace

TEST(Mutation, YieldsASceneOrASceneError) {
    constexpr int kRounds = 4000;
    Random random(20240229);
    Tally tally;
    const std::vector<std::string> names = {"shapes",  "conveyor", "slope",  "car", "gears",
                                            "ragdoll", "balloons", "string", "net", "trampoline"};
    for (const std::string& name : names) {
        const std::string good = text_of(PLUMB_SAMPLES "/scenes/" + name + ".json");
        ASSERT_FALSE(good.empty());
        for (std::size_t round = 0; round < kRounds / names.size(); ++round) {
            std::string text = good;
            for (std::size_t i = random.below(3) + 1; i > 0; --i) {
                random.below(2) ? damage(text, random) : replace_value(text, random);
            }
            expect_scene_or_error(text, tally);
        }
    }
    // Both happen, or the damage is not what it should be.
    EXPECT_GT(tally.scenes, kRounds / 50);
    EXPECT_GT(tally.errors, kRounds / 4);
}

TEST(Mutation, TruncatedScenesAreErrors) {
    const std::string good = text_of(PLUMB_SAMPLES "/scenes/conveyor.json");
    const std::size_t last = good.rfind('}');
    Tally tally;
    for (std::size_t length = 0; length <= last; length += 7)
        expect_scene_or_error(good.substr(0, length), tally);
    EXPECT_EQ(tally.scenes, 0);
    EXPECT_GT(tally.errors, 200);
}

}  // namespace plumb::test
