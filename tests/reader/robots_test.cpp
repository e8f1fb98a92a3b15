// SPDX-License-Identifier: MIT
/// "robots" of a scene.
#include "robots.h"

#include "reading.h"

namespace plumb::test {

namespace {

std::string with_robot(const std::string& keys) {
    return R"({"robots": [{"urdf": "robots/quadruped.urdf")" + keys + "}]}";
}

}  // namespace

TEST(SceneRobots, StandAtTheirPlaces) {
    const Scene scene = scene_of(with_robot(
        R"(, "name": "dog", "position": [1, 2, 3], "joints": {"front_left_knee": -1}, "hold": true,
           "motors": {"front_left_swing": {"velocity": 2, "max": 5}}, "self_collision": false)"));
    EXPECT_EQ(scene.bodies.size(), 13u);
    EXPECT_EQ(scene.joints.size(), 12u);
    EXPECT_EQ(scene.apart.size(), 13u * 12 / 2 - 12);
    double mass = 0;
    for (const BodySpec& b : scene.bodies) mass += *b.mass;
    EXPECT_NEAR(mass, 12 + 0.8 + 4 * (0.6 + 1.2 + 0.4 + 0.1), 1e-12);
    const BodySpec& hip = body(scene, "dog/front_left_hip");
    expect_near(hip.placement.position, {1.2, 2, 3 - 0.13});
    for (const JointSpec& joint : scene.joints) {
        const JointMotor& motor = joint.axes[kTurnX].motor;
        const bool swings = joint.name == "dog/front_left_swing";
        EXPECT_EQ(motor.mode, swings ? MotorMode::velocity : MotorMode::position) << joint.name;
        EXPECT_EQ(motor.greatest, swings ? 5 : 60) << joint.name;
        if (joint.name == "dog/front_left_knee") {
            EXPECT_DOUBLE_EQ(joint.axes[kTurnX].upper, 1);
        }
    }
}

TEST(SceneRobots, LinksCanBeJoinedToOtherBodies) {
    const Scene scene = scene_of(
        R"({"bodies": [{"name": "post", "motion": "fixed", "shape": {"sphere": {"radius": 0.1}}}],
            "robots": [{"urdf": "robots/quadruped.urdf"}],
            "joints": [{"name": "leash", "type": "ball", "bodies": ["quadruped/head", "post"], "anchor": [0, 0, 0]}]})");
    // The head is part of the trunk.
    EXPECT_EQ(scene.bodies[scene.joints.back().body_a].name, "quadruped/trunk");
    EXPECT_EQ(scene.joints.back().name, "leash");
}

TEST(SceneRobots, RefuseWhatIsWrong) {
    expect_error(R"({"robots": [{}]})", "/robots/0", "\"urdf\" is missing");
    expect_error(R"({"robots": [{"urdf": "gone.urdf"}]})", "/robots/0/urdf",
                 "gone.urdf: there is no such file");
    expect_error(with_robot(R"(, "base": "loose")"), "/robots/0/base", "unknown value \"loose\"");
    expect_error(with_robot(R"(, "meshes": 1)"), "/robots/0/meshes", "must be");
    expect_error(with_robot(R"(, "joints": {"front_left_kne": 1})"), "/robots/0/urdf",
                 "did you mean \"front_left_knee\"?");
    expect_error(with_robot(R"(, "joints": {"front_left_knee": "x"})"),
                 "/robots/0/joints/front_left_knee", "must be");
    expect_error(with_robot(R"(, "motors": {"front_left_knee": {}})"),
                 "/robots/0/motors/front_left_knee", "either \"position\" or \"velocity\"");
    expect_error(
        R"({"robots": [{"urdf": "robots/quadruped.urdf"}, {"urdf": "robots/quadruped.urdf"}]})",
        "/robots/1", "there is already a body named \"quadruped/trunk\"");
}

}  // namespace plumb::test
