// SPDX-License-Identifier: MIT
/// Help for the tests of joints: scenes with a few bodies to join.
#pragma once

#include <map>

#include "reading.h"
#include "scene/joint.h"

namespace plumb::test {

/// Two dynamic bodies a, at (0.5, 0, 0), and b, a fixed one f and a kinematic one k, and joints;
/// more keys of the scene may follow.
inline std::string with_joint(const std::string& joint, const std::string& more = "") {
    return R"({"shapes": {"s": {"sphere": {"radius": 1}}}, "bodies": [
        {"name": "a", "shape": "s", "position": [0.5, 0, 0]}, {"name": "b", "shape": "s"},
        {"name": "f", "shape": "s", "motion": "fixed"},
        {"name": "k", "shape": "s", "motion": "kinematic"}], "joints": [)" +
           joint + "]" + more + "}";
}

/// The one joint of a text.
inline JointSpec joint_of(const std::string& text) {
    const Scene scene = scene_of(text);
    EXPECT_EQ(scene.joints.size(), 1u);
    return scene.joints.at(0);
}

inline JointAxis axis_named(const std::string& name) {
    static const std::map<std::string, JointAxis> axes = {
        {"x", kAlongX},     {"y", kAlongY},     {"z", kAlongZ},    {"turn_x", kTurnX},
        {"turn_y", kTurnY}, {"turn_z", kTurnZ}, {"twist", kTurnX}, {"swing", kTurnY}};
    return axes.at(name);
}

}  // namespace plumb::test
