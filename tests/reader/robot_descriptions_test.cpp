// SPDX-License-Identifier: MIT
/// Robots that no file describes.
#include "reader/robots/robot.h"
#include "scene/build.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb::test {
namespace {

/// A post, and on it an arm of 2 kg that turns about x, whose hand is tied to it.
RobotDescription post_with_an_arm() {
    RobotDescription robot;
    robot.name = "arm";
    const auto add_link = [&](const char* name, double mass) {
        RobotLink link;
        link.name = name;
        if (mass > 0) link.inertia = RobotInertia{mass, mass * Eigen::Matrix3d::Identity(), {}};
        link.shapes.push_back({{}, sphere(0.1)});
        robot.links.push_back(link);
    };
    add_link("post", 0), add_link("arm", 2), add_link("hand", 1);
    const auto add_joint = [&](const char* name, RobotJointKind kind, std::uint32_t parent,
                               std::uint32_t child, const Eigen::Vector3d& at) {
        RobotJoint joint;
        joint.name = name, joint.kind = kind, joint.child = child;
        joint.in_parent.position = at;
        robot.links[parent].joints.push_back(static_cast<std::uint32_t>(robot.joints.size()));
        robot.joints.push_back(joint);
    };
    add_joint("elbow", RobotJointKind::hinge, 0, 1, {0, 0, 1});
    add_joint("wrist", RobotJointKind::fixed, 1, 2, {0, 0.5, 0});
    robot.joints[0].limits = RobotLimits{-1, 1};
    robot.joints[0].greatest_effort = 7;
    return robot;
}

std::string error_of(RobotDescription robot, const RobotOptions& options = {}) {
    try {
        Scene scene;
        add_robot(scene, std::move(robot), "no/file", options);
    } catch (const SceneError& error) {
        EXPECT_EQ(error.file(), "no/file");
        return error.what();
    }
    return "no error";
}

TEST(RobotDescriptions, BecomeBodiesAndJoints) {
    Scene scene;
    RobotOptions options;
    options.motors["elbow"].target = 0.5;
    const Robot robot = add_robot(scene, post_with_an_arm(), "no/file", options);
    EXPECT_EQ(robot.name, "arm");
    ASSERT_EQ(scene.bodies.size(), 2u);
    EXPECT_EQ(scene.bodies[0].motion, Motion::fixed);
    EXPECT_EQ(*scene.bodies[1].mass, 3);
    EXPECT_LT((scene.bodies[1].placement.position - Eigen::Vector3d(0, 1, 0)).norm(), 1e-12)
        << "z points up in a robot, y in a scene";
    ASSERT_EQ(scene.joints.size(), 1u);
    EXPECT_EQ(scene.joints[0].kind, JointKind::hinge);
    EXPECT_EQ(scene.joints[0].name, "arm/elbow");
    const JointAxisSpec& axis = scene.joints[0].axes[kTurnX];
    EXPECT_EQ(axis.upper, 1);
    EXPECT_EQ(axis.motor.greatest, 7);
}

TEST(RobotDescriptions, ThatAreNoTreesAreRefused) {
    const auto expect = [](const RobotDescription& robot, const std::string& words) {
        EXPECT_NE(error_of(robot).find(words), std::string::npos) << error_of(robot);
    };
    expect({}, "it has no root link");
    RobotDescription robot = post_with_an_arm();
    robot.root = 3;
    expect(robot, "it has no root link");
    robot = post_with_an_arm(), robot.root = 1;
    expect(robot, "link \"arm\", the root, hangs on joint \"elbow\"");
    robot = post_with_an_arm(), robot.joints[1].child = 7;
    expect(robot, "joint \"wrist\" has no child link");
    robot = post_with_an_arm(), robot.joints[1].child = 1;
    expect(robot, "link \"arm\" is the child of two joints");
    robot = post_with_an_arm(), robot.links[2].joints = {5};
    expect(robot, "link \"hand\" carries an unknown joint");
    robot = post_with_an_arm(), robot.links[2].joints = {1};
    expect(robot, "link \"hand\" hangs twice on one joint");
    robot = post_with_an_arm(), robot.links[0].joints.clear();
    expect(robot, "the root, \"post\", does not reach it");
}

TEST(RobotDescriptions, WithPartsThatCannotBeAreRefused) {
    const auto expect = [](const RobotDescription& robot, const std::string& words) {
        EXPECT_NE(error_of(robot).find(words), std::string::npos) << error_of(robot);
    };
    RobotDescription robot = post_with_an_arm();
    robot.links[2].name = "arm";
    expect(robot, "there are two of the name link \"arm\"");
    robot = post_with_an_arm(), robot.joints[1].name = "elbow";
    expect(robot, "there are two of the name joint \"elbow\"");
    robot = post_with_an_arm(), robot.links[1].shapes[0].geometry = sphere(-1);
    expect(robot, "link \"arm\": the radius of a sphere must be a number");
    robot = post_with_an_arm(), robot.links[1].shapes[0].geometry = Geometry{};
    std::get<Geometry>(robot.links[1].shapes[0].geometry).kind = ShapeKind::plane;
    expect(robot, "link \"arm\": its shapes may be spheres");
    robot = post_with_an_arm(), robot.joints[0].limits = RobotLimits{NAN, 1};
    expect(robot, "joint \"elbow\": its lower limit is above the upper one");
}

TEST(RobotDescriptions, MotorsHaveTheNearestName) {
    RobotOptions options;
    options.motors["elbo"].target = 0.5;
    const std::string error = error_of(post_with_an_arm(), options);
    EXPECT_NE(error.find("there is no joint \"elbo\""), std::string::npos) << error;
    EXPECT_NE(error.find("elbow"), std::string::npos) << error;
}

}  // namespace
}  // namespace plumb::test
