// SPDX-License-Identifier: MIT
#include "reading.h"

#include <numbers>

namespace plumb::test {

namespace {

BodySpec body_of(const std::string& keys) { return scene_of(with_body(keys)).bodies.at(0); }

}  // namespace

TEST(Bodies, FillAllMembers) {
    const BodySpec b = body_of(R"("name": "ball", "position": [1, 2, 3], "velocity": [4, 5, 6],
        "angular_velocity": [7, 8, 9], "mass": 2, "inertia": [3, 4, 5], "force": [1, 0, 0], "torque": [0, 1, 0],
        "group": 2, "mask": 4294967295, "color": "#1234aB")");
    EXPECT_EQ(b.name, "ball");
    EXPECT_EQ(b.motion, Motion::dynamic);
    EXPECT_EQ(b.geometry, 0u);
    EXPECT_EQ(b.placement.position, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(b.velocity, Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(b.angular_velocity, Eigen::Vector3d(7, 8, 9));
    EXPECT_EQ(b.mass, 2.0);
    EXPECT_EQ(b.inertia, Eigen::Vector3d(3, 4, 5));
    EXPECT_EQ(b.force, Eigen::Vector3d(1, 0, 0));
    EXPECT_EQ(b.torque, Eigen::Vector3d(0, 1, 0));
    EXPECT_EQ(b.group, 2u);
    EXPECT_EQ(b.mask, ~0u);
    EXPECT_EQ(b.color, 0x1234abu);
}

TEST(Bodies, BlackIsNotTheViewersChoice) { EXPECT_EQ(body_of(R"("color": "#000000")").color, 1u); }

TEST(Bodies, RotationsMeanTheSameInEachNotation) {
    const double half = std::numbers::pi / 6;
    const Eigen::Quaterniond wanted(std::cos(half), 0, 0, std::sin(half));  // 60° about z
    for (const std::string rotation :
         {R"({"axis": [0, 0, 5], "degrees": 60})", R"({"euler_degrees": [0, 0, 60]})",
          R"({"quaternion": [0, 0, 1, 1.7320508075688772]})"}) {
        const auto q = body_of("\"rotation\": " + rotation).placement.rotation;
        EXPECT_LT(q.angularDistance(wanted), 1e-12) << rotation;
        EXPECT_NEAR(q.norm(), 1, 1e-15);
    }
}

TEST(Bodies, EulerAnglesTurnAboutOuterXThenYThenZ) {
    const auto q = body_of(R"("rotation": {"euler_degrees": [90, 0, 90]})").placement.rotation;
    // About x first, y goes to z, which the turn about z leaves alone.
    EXPECT_LT((q * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(Bodies, RefuseWhatIsNoRotation) {
    const std::string at = "/bodies/0/rotation";
    expect_error(with_body(R"("rotation": {"quaternion": [0, 0, 0, 0]})"), at + "/quaternion",
                 "zero");
    expect_error(with_body(R"("rotation": {"axis": [0, 0, 0], "degrees": 1})"), at + "/axis",
                 "zero");
    expect_error(with_body(R"("rotation": {"axis": [0, 0, 1]})"), at, "go together");
    expect_error(with_body(R"("rotation": {})"), at, "must be one of");
    expect_error(
        with_body(R"("rotation": {"axis": [0,0,1], "degrees": 1, "euler_degrees": [0,0,0]})"), at,
        "must be one of");
    expect_error(with_body(R"("rotation": [0, 0, 0, 1])"), at, "must be an object");
}

TEST(Bodies, RefuseImpossibleNumbers) {
    expect_error(with_body(R"("mass": 0)"), "/bodies/0/mass", "above 0");
    expect_error(with_body(R"("mass": -1)"), "/bodies/0/mass", "above 0");
    expect_error(with_body(R"("mass": "NaN")"), "/bodies/0/mass", "must be a number");
    expect_error(with_body(R"("inertia": [1, 1, 2.1])"), "/bodies/0/inertia",
                 "sum of the other two");
    expect_error(with_body(R"("position": [0, 1e10, 0])"), "/bodies/0/position/1",
                 "from -1000000000 to");
    expect_error(with_body(R"("position": [0, null, 0])"), "/bodies/0/position/1", "is null");
    expect_error(with_body(R"("group": -1)"), "/bodies/0/group", "whole number");
    expect_error(with_body(R"("color": "red")"), "/bodies/0/color", "#ff8800");
    expect_error(with_body(R"("color": "#12345g")"), "/bodies/0/color", "#ff8800");
}

TEST(Bodies, AFlatBodysInertiaIsAllowed) {
    EXPECT_EQ(body_of(R"("inertia": [1, 1, 2])").inertia, Eigen::Vector3d(1, 1, 2));
}

TEST(Bodies, RefuseWhatDoesNotFitTheirMotion) {
    expect_error(with_body(R"("motion": "static")"), "/bodies/0/motion",
                 "Allowed: dynamic, fixed, kinematic");
    expect_error(with_body(R"("motion": "fixed", "velocity": [1, 0, 0])"), "/bodies/0",
                 "no velocity");
    expect_error(with_body(R"("motion": "kinematic", "force": [1, 0, 0])"), "/bodies/0",
                 "only a dynamic body");
    expect_error(with_body(R"("script": {"keyframes": [{"time": 0}]})"), "/bodies/0/script",
                 "kinematic");
    expect_error(R"({"bodies": [{"shape": {"plane": {}}}]})", "/bodies/0", "\"motion\": \"fixed\"");
}

TEST(Bodies, WithoutAShapeNeedMassAndInertia) {
    expect_error(R"({"bodies": [{"mass": 1}]})", "/bodies/0", "\"inertia\"");
    expect_error(R"({"bodies": [{"motion": "fixed"}]})", "/bodies/0", "\"shape\" is missing");
    const Scene scene = scene_of(R"({"bodies": [{"mass": 1, "inertia": [1, 1, 1]}]})");
    EXPECT_EQ(scene.bodies[0].geometry, kNoIndex);
}

TEST(Bodies, ScriptsKeepWhatAKeyframeLeavesOut) {
    const BodySpec b =
        body_of(R"("motion": "kinematic", "position": [1, 2, 3], "script": {"loop": true,
        "keyframes": [{"time": 0}, {"time": 2, "position": [4, 5, 6]}]})");
    ASSERT_EQ(b.script.keyframes.size(), 2u);
    EXPECT_TRUE(b.script.loop);
    EXPECT_EQ(b.script.keyframes[0].placement.position, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(b.script.keyframes[1].placement.position, Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(b.script.keyframes[1].time, 2);
}

TEST(Bodies, RefuseScriptsThatGoBackInTime) {
    const std::string head = R"("motion": "kinematic", "script": )", at = "/bodies/0/script";
    expect_error(with_body(head + R"({"keyframes": [{"time": 1}, {"time": 1}]})"),
                 at + "/keyframes/1/time", "later");
    expect_error(with_body(head + R"({"keyframes": []})"), at + "/keyframes", "at least one");
    expect_error(with_body(head + R"({"keyframes": [{"time": 1}], "loop": true})"), at,
                 "two keyframes");
    expect_error(with_body(head + "{}"), at, "\"keyframes\" is missing");
}

TEST(Bodies, HaveNamesOfTheirOwn) {
    const Scene scene = scene_of(R"({"shapes": {"s": {"sphere": {"radius": 1}}}, "bodies": [
        {"shape": "s"}, {"shape": "s", "name": "body_0001"}]})");
    EXPECT_EQ(scene.bodies[0].name, "body_0001_");
    EXPECT_EQ(scene.bodies[1].name, "body_0001");
    expect_error(R"({"shapes": {"s": {"sphere": {"radius": 1}}}, "bodies": [
        {"shape": "s", "name": "a"}, {"shape": "s", "name": "a"}]})",
                 "/bodies/1", "already a body named \"a\"");
}

TEST(View, IsReadAndChecked) {
    const Scene scene =
        scene_of(R"({"view": {"eye": [1, 2, 3], "target": [0, 0, 0], "field_of_view": 30}})");
    ASSERT_TRUE(scene.view.has_value());
    EXPECT_EQ(scene.view->eye, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(scene.view->field_of_view, 30);
    EXPECT_FALSE(scene_of("{}").view.has_value());
    expect_error(R"({"view": {"eye": [0, 0, 0], "target": [0, 0, 0]}})", "/view", "same point");
    expect_error(R"({"view": {"field_of_view": 180}})", "/view/field_of_view", "from 1 to 170");
}

}  // namespace plumb::test
