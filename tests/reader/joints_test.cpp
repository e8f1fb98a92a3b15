// SPDX-License-Identifier: MIT
#include "reading.h"

namespace plumb::test {

namespace {

/// Two dynamic bodies a and b, a fixed one f and a kinematic one k, and one joint.
std::string with_joint(const std::string& joint) {
    return R"({"shapes": {"s": {"sphere": {"radius": 1}}}, "bodies": [
        {"name": "a", "shape": "s"}, {"name": "b", "shape": "s"}, {"name": "f", "shape": "s", "motion": "fixed"},
        {"name": "k", "shape": "s", "motion": "kinematic"}], "joints": [)" +
           joint + "]}";
}

std::string ball_joint(const std::string& bodies) {
    return with_joint(R"({"type": "ball", "anchor": [0, 0, 0], "bodies": )" + bodies + "}");
}

}  // namespace

TEST(Joints, FillAllMembers) {
    const Scene scene = scene_of(with_joint(R"(
        {"name": "j", "type": "ball", "bodies": ["a", "b"], "anchor": [1, 2, 3], "collide": true},
        {"type": "ball", "bodies": ["b"], "anchor": [0, 0, 0]})"));
    ASSERT_EQ(scene.joints.size(), 2u);
    EXPECT_EQ(scene.joints[0].name, "j");
    EXPECT_EQ(scene.joints[0].body_a, 0u);
    EXPECT_EQ(scene.joints[0].body_b, 1u);
    EXPECT_EQ(scene.joints[0].anchor, Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(scene.joints[0].collide);
    EXPECT_EQ(scene.joints[1].name, "joint_2");
    EXPECT_EQ(scene.joints[1].body_a, 1u);
    EXPECT_EQ(scene.joints[1].body_b, kNoIndex);
}

TEST(Joints, RefuseBodiesThatCannotBeJoined) {
    const std::string at = "/joints/0/bodies";
    expect_error(ball_joint(R"(["a", "c"])"), at + "/1", "there is no body named \"c\"");
    expect_error(ball_joint(R"(["a", "a"])"), at, "itself");
    expect_error(ball_joint(R"(["f", "k"])"), at, "at least one");
    expect_error(ball_joint(R"(["f"])"), at, "at least one");
    expect_error(ball_joint("[]"), at, "a list of two bodies");
    EXPECT_EQ(scene_of(ball_joint(R"(["a", "f"])")).joints.size(), 1u);
}

TEST(Joints, RefuseWhatIsMissingOrUnknown) {
    expect_error(with_joint(R"({"type": "ball", "bodies": ["a", "b"]})"), "/joints/0",
                 "\"anchor\" is missing");
    expect_error(with_joint(R"({"type": "bal", "bodies": ["a"], "anchor": [0,0,0]})"),
                 "/joints/0/type", "did you mean \"ball\"?");
}

}  // namespace plumb::test
