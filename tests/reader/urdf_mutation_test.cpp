// SPDX-License-Identifier: MIT
/// Whatever a URDF file says, it becomes a robot of finite numbers or a SceneError.
#include <cmath>

#include "math/random.h"
#include "robots.h"

namespace plumb::test {

namespace {

using plumb::Random;

constexpr const char* kFragments[] = {"0",      "0.5",   "2",         "0.1 0 0",  "-1",    "1e308",
                                      "-1e308", "1e999", "nan",       "1e-320",   "",      "0 0 0",
                                      "1 2",    "x",     "<link/>",   "<",        ">",     "/>",
                                      "\"",     "<!--",  "&#0;",      "\xff",     "trunk", "mesh",
                                      "mimic",  "fixed", "prismatic", "floating", "planar"};

/// Changes a text in one place: a stretch of it is dropped, doubled or replaced, or a value in
/// quotes is.
void damage(std::string& text, Random& random) {
    const std::string fragment = kFragments[random.below(std::size(kFragments))];
    std::size_t at = random.below(text.size()),
                length = std::min(random.below(12), text.size() - at);
    if (random.below(3) > 0) {
        at = text.find('"', at);
        if (at == std::string::npos) return;
        ++at;
        length = std::min(text.find('"', at), text.size()) - at;
    }
    if (random.below(4) == 0)
        text.insert(at, text.substr(at, length));
    else
        text.replace(at, length, fragment);
}

bool finite(const Scene& scene) {
    bool good = true;
    for (const BodySpec& b : scene.bodies) {
        good = good && b.placement.position.allFinite() &&
               std::abs(b.placement.rotation.norm() - 1) < 1e-9;
        if (b.motion != Motion::dynamic) continue;
        good = good && std::isfinite(*b.mass) && *b.mass > 0 && b.inertia->minCoeff() > 0 &&
               b.inertia->allFinite() && b.mass_frame->position.allFinite();
    }
    for (const JointSpec& joint : scene.joints) {
        good = good && joint.anchor.allFinite() && std::abs(joint.frame.norm() - 1) < 1e-9;
        for (const JointAxisSpec& axis : joint.axes)
            good = good && axis.lower <= axis.upper && std::isfinite(axis.damping) &&
                   std::isfinite(axis.friction) && axis.motor.frequency > 0 &&
                   std::isfinite(axis.motor.frequency);
    }
    return good;
}

}  // namespace

TEST_F(Robots, SurviveDamage) {
    std::ifstream file(PLUMB_SAMPLES "/scenes/robots/quadruped.urdf");
    const std::string good((std::istreambuf_iterator<char>(file)), {});
    ASSERT_FALSE(good.empty());
    RobotOptions options;
    options.hold = true;
    Random random(20240301);
    int robots = 0, errors = 0;
    for (int round = 0; round < 800; ++round) {
        std::string text = good;
        for (std::size_t i = random.below(2) + 1; i > 0; --i) damage(text, random);
        try {
            Scene scene;
            add_robot(scene, write("robot.urdf", text), options);
            EXPECT_TRUE(finite(scene)) << text;
            ++robots;
        } catch (const SceneError& error) {
            EXPECT_GT(std::string(error.what()).size(), error.file().size() + 10) << text;
            ++errors;
        } catch (const std::exception& error) {
            FAIL() << "not a SceneError: " << error.what() << "\n" << text;
        }
    }
    EXPECT_GT(robots, 40);
    EXPECT_GT(errors, 200);
}

}  // namespace plumb::test
