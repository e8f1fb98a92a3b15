// SPDX-License-Identifier: MIT
#include "joining.h"

namespace plumb::test {

namespace {

const double kInfinity = std::numeric_limits<double>::infinity();

/// A hinge of body a with the world, with more keys.
std::string hinge(const std::string& keys) {
    return with_joint(
        R"({"type": "hinge", "bodies": ["a"], "anchor": [0, 0, 0], "axis": [0, 0, 1], )" + keys +
        "}");
}
std::string distance(const std::string& keys, const std::string& anchor_b = "[0, 3, 4]") {
    return with_joint(R"({"type": "distance", "bodies": ["a"], "anchor": [0, 0, 0], "anchor_b": )" +
                      anchor_b + ", " + keys + "}");
}
std::string cone(const std::string& axes) {
    return with_joint(
        R"({"type": "cone_twist", "bodies": ["a"], "anchor": [0, 0, 0], "axis": [0, 0, 1],
            "axes": )" +
        axes + "}");
}

JointAxisSpec axis_of(const std::string& keys) { return joint_of(hinge(keys)).axes[kTurnX]; }

}  // namespace

TEST(JointDrives, LimitsMayBeOpenAtOneEnd) {
    EXPECT_EQ(axis_of(R"("limits": [-1, 2])").lower, -1);
    EXPECT_EQ(axis_of(R"("limits": [-1, 2])").upper, 2);
    EXPECT_EQ(axis_of(R"("limits": [null, 2])").lower, -kInfinity);
    EXPECT_EQ(axis_of(R"("limits": [-1, null])").upper, kInfinity);
    EXPECT_EQ(axis_of(R"("friction": 1)").upper, kInfinity);
    const std::string at = "/joints/0/limits";
    expect_error(hinge(R"("limits": [2, 1])"), at, "the lower limit is above");
    expect_error(hinge(R"("limits": [null, null])"), at, "at least one");
    expect_error(hinge(R"("limits": [1])"), at, "a list of 2 numbers or null");
    expect_error(hinge(R"("limits": [1, "2"])"), at + "/1", "must be a number");
}

TEST(JointDrives, MotorsHoldASpeedOrAPlace) {
    const JointMotor speed = axis_of(R"("motor": {"velocity": 3, "max": 40})").motor;
    EXPECT_EQ(speed.mode, MotorMode::velocity);
    EXPECT_EQ(speed.target, 3);
    EXPECT_EQ(speed.greatest, 40);
    EXPECT_TRUE(speed.keys.empty());

    const JointMotor place =
        axis_of(R"("motor": {"position": -0.5, "frequency": 2, "damping_ratio": 0.7})").motor;
    EXPECT_EQ(place.mode, MotorMode::position);
    EXPECT_EQ(place.target, -0.5);
    EXPECT_EQ(place.greatest, kInfinity);
    EXPECT_EQ(place.frequency, 2);
    EXPECT_EQ(place.damping_ratio, 0.7);

    const JointMotor keys = axis_of(R"("motor": {"velocity": [[0, 1], [2, -3]]})").motor;
    EXPECT_EQ(keys.mode, MotorMode::velocity);
    ASSERT_EQ(keys.keys.size(), 2u);
    EXPECT_EQ(keys.keys[1].time, 2);
    EXPECT_EQ(keys.keys[1].value, -3);
}

TEST(JointDrives, RefuseMotorsThatMakeNoSense) {
    const std::string at = "/joints/0/motor";
    const auto motor = [](const std::string& keys) { return hinge("\"motor\": {" + keys + "}"); };
    expect_error(motor(""), at, "needs either \"velocity\" or \"position\"");
    expect_error(motor(R"("velocity": 1, "position": 1)"), at + "/position", "not both");
    expect_error(motor(R"("velocity": "fast")"), at + "/velocity",
                 "a number or a list of [time, value]");
    expect_error(motor(R"("velocity": [])"), at + "/velocity", "at least one");
    expect_error(motor(R"("velocity": [[0, 1], [0, 2]])"), at + "/velocity/1/0", "later");
    expect_error(hinge(R"("axes": {"turn_x": {"motor": {"position": [[0, 1], [2, 2], [1, 3]]}}})"),
                 "/joints/0/axes/turn_x/motor/position/2/0", "later");
    expect_error(motor(R"("velocity": [[-1, 1]])"), at + "/velocity/0/0", "from 0");
    expect_error(motor(R"("velocity": [1, 2])"), at + "/velocity/0", "a time and a value");
    expect_error(motor(R"("velocity": 1, "frequency": 2)"), at + "/frequency", "\"position\"");
    expect_error(motor(R"("position": 1, "max": -1)"), at + "/max", "from 0");
    expect_error(motor(R"("position": 1, "maximum": 1)"), at + "/maximum", "unknown key");
}

TEST(JointDrives, SpringsAndFrictionAreRead) {
    const JointAxisSpec axis =
        axis_of(R"("spring": {"stiffness": 100, "rest": 0.2, "damping": 3}, "friction": 0.4)");
    EXPECT_EQ(axis.stiffness, 100);
    EXPECT_EQ(axis.rest, 0.2);
    EXPECT_EQ(axis.damping, 3);
    EXPECT_EQ(axis.friction, 0.4);
    EXPECT_EQ(axis.greatest_speed, kInfinity);
    EXPECT_EQ(axis_of(R"("max_speed": 2)").greatest_speed, 2);
    EXPECT_EQ(axis_of(R"("spring": {"damping": 3})").stiffness, 0);
    expect_error(hinge(R"("spring": {"rest": 1})"), "/joints/0/spring", "a \"stiffness\" or");
    expect_error(hinge(R"("spring": {"stiffness": -1})"), "/joints/0/spring/stiffness", "from 0");
    expect_error(hinge(R"("friction": -1)"), "/joints/0/friction", "from 0");
    expect_error(hinge(R"("max_speed": -1)"), "/joints/0/max_speed", "from 0");
}

TEST(JointDrives, StandInOnePlaceAlone) {
    EXPECT_EQ(axis_of(R"("axes": {"turn_x": {"friction": 2}})").friction, 2);
    expect_error(hinge(R"("limits": [-1, 1], "axes": {"turn_x": {"friction": 2}})"),
                 "/joints/0/axes/turn_x", "must be in one place");
    expect_error(hinge(R"("axes": [])"), "/joints/0/axes", "an object of axes");
    expect_error(hinge(R"("axes": {"turn_x": {"limit": 2}})"), "/joints/0/axes/turn_x/limit",
                 "did you mean \"limits\"?");
    // What does not belong to the first axis does not clash with it.
    const JointSpec joint =
        joint_of(with_joint(R"({"type": "point_on_line", "bodies": ["a"], "anchor": [0, 0, 0],
            "axis": [1, 0, 0], "limits": [0, 1], "axes": {"turn_x": {"friction": 2}}})"));
    EXPECT_EQ(joint.axes[kAlongX].upper, 1);
    EXPECT_EQ(joint.axes[kTurnX].friction, 2);
}

TEST(JointDrives, OfADistanceMeasureTheDistance) {
    const JointAxisSpec spring = joint_of(distance(R"("spring": {"stiffness": 9})")).axes[kAlongX];
    EXPECT_EQ(spring.rest, 5);  // the distance at the start
    const auto given = distance(R"("axes": {"x": {"spring": {"stiffness": 9, "rest": 1}}})");
    EXPECT_EQ(joint_of(given).axes[kAlongX].rest, 1);
    const auto beside = distance(R"("axes": {"x": {"spring": {"stiffness": 9}}})");
    EXPECT_EQ(joint_of(beside).axes[kAlongX].rest, 5);
    const auto rope = distance(R"("limits": [null, 5], "spring": {"damping": 1}, "friction": 1)");
    EXPECT_EQ(joint_of(rope).axes[kAlongX].upper, 5);

    const std::string rod = "is a rod, along which nothing moves";
    expect_error(distance(R"("friction": 1)"), "/joints/0/friction", rod);
    expect_error(distance(R"("spring": {"damping": 1})"), "/joints/0/spring", rod);
    expect_error(distance(R"("axes": {"x": {"motor": {"velocity": 1}}})"), "/joints/0/axes/x/motor",
                 rod);
    expect_error(distance(R"("limits": [-2, -1])"), "/joints/0/limits", "never negative");
    expect_error(distance(R"("limits": [-1, 5])"), "/joints/0/limits", "[least, greatest]");
    expect_error(distance(R"("limits": [-1, null])"), "/joints/0/limits", "0 or above, or null");
    expect_error(distance(R"("axes": {"x": {"limits": [null, -1]}})"), "/joints/0/axes/x/limits",
                 "never negative");
    expect_error(distance(R"("collide": true)", "[0, 0, 0]"), "/joints/0/anchor_b",
                 "two anchors that are apart");
}

TEST(JointDrives, OfASwingHaveNoDirection) {
    const JointSpec joint =
        joint_of(cone(R"({"twist": {"limits": [-0.5, 0.25]}, "swing": {"limits": [0, 0.75]}})"));
    EXPECT_EQ(joint.axes[kTurnX].lower, -0.5);
    EXPECT_EQ(joint.axes[kTurnX].upper, 0.25);
    EXPECT_EQ(joint.axes[kTurnY].lower, 0);
    EXPECT_EQ(joint.axes[kTurnY].upper, 0.75);
    const std::string at = "/joints/0/axes/swing/limits";
    EXPECT_EQ(joint_of(cone(R"({"swing": {"limits": [null, 1]}})")).axes[kTurnY].upper, 1);
    EXPECT_EQ(joint_of(cone(R"({"swing": {"limits": [0, 3.1416]}})")).axes[kTurnY].upper, 3.1416);
    expect_error(cone(R"({"swing": {"limits": [-1, 1]}})"), at, "to either side by 1 is [0, 1]");
    expect_error(cone(R"({"swing": {"limits": [-2, -1]}})"), at, "never negative");
    expect_error(cone(R"({"swing": {"limits": [0, 3.2]}})"), at, "at most half a turn");
    expect_error(cone(R"({"swing": {"limits": [-1, null]}})"), at, "[0, greatest]");
    expect_error(cone(R"({"swing": {"limits": [0.1, 1]}})"), at, "[0, greatest]");
    expect_error(cone(R"({"swing": {"limits": [null, -1]}})"), at, "[0, greatest]");
    expect_error(cone(R"({"swing": {"limits": [0, null]}})"), at, "[0, greatest]");
    expect_error(cone(R"({"swing": {"motor": {"velocity": 1}}})"), "/joints/0/axes/swing/motor",
                 "no direction");
}

}  // namespace plumb::test
