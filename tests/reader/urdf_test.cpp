// SPDX-License-Identifier: MIT
/// Links and joints of URDF files against what is computed by hand. A URDF's (x, y, z) is the
/// scene's (x, z, −y).
#include "reader/robots/robot.h"

#include <cmath>
#include <numbers>

#include "robots.h"

namespace plumb::test {

namespace {

using std::numbers::pi;

/// The centre of mass of a body in the world.
Eigen::Vector3d centre_of(const BodySpec& b) { return (b.placement * *b.mass_frame).position; }

/// The tensor of inertia of a body about its centre, in the world's axes.
Eigen::Matrix3d tensor_of(const BodySpec& b) {
    const Eigen::Matrix3d r = (b.placement * *b.mass_frame).rotation.toRotationMatrix();
    return r * b.inertia->asDiagonal() * r.transpose();
}

/// A URDF's tensor as the scene's axes see it.
Eigen::Matrix3d turned(const Eigen::Matrix3d& tensor) {
    Eigen::Matrix3d r;
    r << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return r * tensor * r.transpose();
}

}  // namespace

TEST_F(Robots, LinksHaveTheMassesOfTheirInertials) {
    const Scene scene = scene_of("<link name=\"a\">" +
                                 inertial("1 2 2.5", "3", "0.1 0.2 0.3", "0 0 0.5") + "</link>");
    ASSERT_EQ(scene.bodies.size(), 1u);
    const BodySpec& a = scene.bodies[0];
    EXPECT_EQ(a.name, "r/a");
    EXPECT_EQ(a.motion, Motion::dynamic);
    EXPECT_EQ(a.geometry, kNoIndex);
    EXPECT_EQ(*a.mass, 3);
    expect_near(centre_of(a), {0.1, 0.3, -0.2});

    const Eigen::Matrix3d r = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Matrix3d wanted =
        turned(r * Eigen::Vector3d(1, 2, 2.5).asDiagonal() * r.transpose());
    EXPECT_LE((tensor_of(a) - wanted).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Robots, FixedJointsMakeOneBody) {
    const Scene scene =
        scene_of(link("a") + "<link name=\"b\">" + inertial("1 1 1", "1", "0 0 0") +
                 "</link><link name=\"c\"/>" + joint("fixed", "a", "b", "<origin xyz=\"3 0 0\"/>") +
                 joint("fixed", "b", "c", "<origin xyz=\"0 1 0\"/>"));
    ASSERT_EQ(scene.bodies.size(), 1u);
    EXPECT_TRUE(scene.joints.empty());
    const BodySpec& a = scene.bodies[0];
    EXPECT_EQ(*a.mass, 3);
    expect_near(centre_of(a), {1, 0, 0});
    // Steiner: 2 · 1² + 1 · 2² = 6 across the line between the two.
    const Eigen::Matrix3d wanted = turned(Eigen::Vector3d(2, 3 + 6, 3.5 + 6).asDiagonal());
    EXPECT_LE((tensor_of(a) - wanted).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Robots, NamesOfMergedLinksStandForTheirBody) {
    Scene scene;
    const Robot robot =
        add_robot(scene,
                  write("robot.urdf",
                        Robots::robot(link("a") + link("b") + link("c") + joint("fixed", "a", "b") +
                                      joint("continuous", "b", "c"))),
                  {});
    const std::vector<std::pair<std::string, std::uint32_t>> links = {
        {"r/a", 0}, {"r/b", 0}, {"r/c", 1}};
    EXPECT_EQ(robot.links, links);
    ASSERT_EQ(robot.joints.size(), 1u);
    EXPECT_EQ(robot.joints[0].first, "r/bc");
    EXPECT_EQ(scene.joints[0].body_a, 1u);
    EXPECT_EQ(scene.joints[0].body_b, 0u);
    EXPECT_FALSE(scene.joints[0].collide);
}

TEST_F(Robots, OneShapeIsTheBodysAndSeveralAreACompound) {
    const std::string origin = R"(<origin xyz="1 0 2" rpy="0 0 0.5"/>)";
    const Scene one = scene_of(link("a", collision(R"(<box size="2 4 6"/>)", origin)));
    ASSERT_EQ(one.geometries.size(), 1u);
    EXPECT_EQ(one.geometries[0].kind, ShapeKind::box);
    expect_near(one.geometries[0].half_extents, {1, 2, 3});
    expect_near(one.bodies[0].placement.position, {1, 2, 0});
    expect_near(centre_of(one.bodies[0]), {0, 0, 0});

    const Scene two = scene_of(link("a", collision(R"(<sphere radius="0.5"/>)") +
                                             collision(R"(<sphere radius="0.25"/>)", origin)) +
                               link("b", collision(R"(<sphere radius="2"/>)")) +
                               joint("fixed", "a", "b", R"(<origin xyz="0 0 1"/>)"));
    ASSERT_EQ(two.geometries.size(), 1u);
    const Geometry& compound = two.geometries[0];
    EXPECT_EQ(compound.kind, ShapeKind::compound);
    ASSERT_EQ(compound.parts.size(), 3u);
    EXPECT_EQ(compound.parts[1].geometry.radius, 0.25);
    expect_near(compound.parts[1].local.position, {1, 0, 2});
    EXPECT_EQ(compound.parts[2].geometry.radius, 2);
    expect_near(compound.parts[2].local.position, {0, 0, 1});
}

TEST_F(Robots, CylindersStandAlongZ) {
    const Scene scene = scene_of(link("a", collision(R"(<cylinder radius="0.1" length="3"/>)")));
    EXPECT_EQ(scene.geometries[0].kind, ShapeKind::cylinder);
    EXPECT_EQ(scene.geometries[0].radius, 0.1);
    EXPECT_EQ(scene.geometries[0].half_height, 1.5);
    const Eigen::Vector3d up = scene.bodies[0].placement.rotation * Eigen::Vector3d::UnitY();
    expect_near(up, {0, 1, 0}, 1e-15);
}

TEST_F(Robots, HingesAndSlidersKeepTheirAxesLimitsAndDynamics) {
    const Scene scene = scene_of(
        link("a") + link("b") + link("c") + link("d") +
        joint(
            "revolute", "a", "b",
            kLimit +
                R"(<origin xyz="0 0 1"/><axis xyz="0 0 2"/><dynamics damping="0.5" friction="0.25"/>)") +
        joint("prismatic", "b", "c", kLimit + R"(<axis xyz="0 1 0"/>)") +
        joint("continuous", "c", "d"));
    ASSERT_EQ(scene.joints.size(), 3u);
    const JointSpec &hinge = scene.joints[0], &slider = scene.joints[1], &wheel = scene.joints[2];

    EXPECT_EQ(hinge.kind, JointKind::hinge);
    expect_near(hinge.anchor, {0, 1, 0});
    expect_near(hinge.frame * Eigen::Vector3d::UnitX(), {0, 1, 0});
    EXPECT_EQ(hinge.axes[kTurnX].lower, -1);
    EXPECT_EQ(hinge.axes[kTurnX].upper, 2);
    EXPECT_EQ(hinge.axes[kTurnX].damping, 0.5);
    EXPECT_EQ(hinge.axes[kTurnX].friction, 0.25);
    EXPECT_EQ(hinge.axes[kTurnX].greatest_speed, 4);
    EXPECT_EQ(hinge.axes[kTurnX].motor.mode, MotorMode::none);

    EXPECT_EQ(slider.kind, JointKind::slider);
    expect_near(slider.frame * Eigen::Vector3d::UnitX(), {0, 0, -1});
    EXPECT_EQ(slider.axes[kAlongX].lower, -1);
    EXPECT_EQ(slider.axes[kAlongX].upper, 2);

    EXPECT_EQ(wheel.kind, JointKind::hinge);
    expect_near(wheel.frame * Eigen::Vector3d::UnitX(), {1, 0, 0});
    EXPECT_TRUE(std::isinf(wheel.axes[kTurnX].upper));
    EXPECT_TRUE(std::isinf(wheel.axes[kTurnX].greatest_speed));
}

TEST_F(Robots, ALimitOfVelocityOf0MeansNone) {
    const Scene scene = scene_of(
        link("a", collision(R"(<sphere radius="0.3"/>)")) + link("b") +
        joint("revolute", "a", "b", R"(<limit lower="-1" upper="2" effort="1" velocity="0"/>)"));
    EXPECT_TRUE(std::isinf(scene.joints[0].axes[kTurnX].greatest_speed));
}

TEST_F(Robots, PlanarJointsKeepTheirPlaneAndFloatingOnesNothing) {
    const Scene scene = scene_of(link("a") + link("b") + link("c") + joint("floating", "a", "b") +
                                 joint("planar", "a", "c", R"(<axis xyz="0 0 1"/>)"));
    EXPECT_EQ(scene.bodies.size(), 3u);
    ASSERT_EQ(scene.joints.size(), 1u);
    EXPECT_EQ(scene.joints[0].kind, JointKind::planar);
    expect_near(scene.joints[0].frame * Eigen::Vector3d::UnitX(), {0, 1, 0});
}

TEST_F(Robots, StartWhereTheirJointsAreSaidToBe) {
    const std::string arm =
        link("a") + link("b") + link("c") + link("d") +
        joint("revolute", "a", "b", kLimit + R"(<origin xyz="0 0 1"/><axis xyz="0 1 0"/>)") +
        joint("prismatic", "b", "c", kLimit + R"(<origin xyz="2 0 0"/><axis xyz="1 0 0"/>)") +
        joint("continuous", "c", "d",
              R"(<origin xyz="1 0 0" rpy="0 1.5707963267948966 0"/><axis xyz="0 0 1"/>)");
    RobotOptions options;
    options.positions = {{"ab", 0.5}, {"bc", 0.25}, {"cd", 3.0}};
    options.placement.position = {0, 10, 0};
    const Scene scene = scene_of(arm, options);

    // About a URDF's y, the x axis turns downwards.
    const double c = std::cos(0.5), s = std::sin(0.5);
    expect_near(body(scene, "r/b").placement.position, {0, 11, 0});
    expect_near(body(scene, "r/c").placement.position, {2.25 * c, 11 - 2.25 * s, 0});
    expect_near(body(scene, "r/d").placement.position, {3.25 * c, 11 - 3.25 * s, 0});
    expect_near(scene.joints[2].frame * Eigen::Vector3d::UnitX(), {c, -s, 0});

    // Coordinates count from the start.
    EXPECT_DOUBLE_EQ(scene.joints[0].axes[kTurnX].lower, -1.5);
    EXPECT_DOUBLE_EQ(scene.joints[0].axes[kTurnX].upper, 1.5);
    EXPECT_DOUBLE_EQ(scene.joints[1].axes[kAlongX].lower, -1.25);
}

TEST_F(Robots, StartAtTheLimitNearestTo0) {
    const Scene scene = scene_of(
        link("a", collision(R"(<sphere radius="0.3"/>)")) + link("b") +
        joint("revolute", "a", "b", R"(<limit lower="0.5" upper="2" effort="1" velocity="1"/>)"));
    EXPECT_EQ(scene.joints[0].axes[kTurnX].lower, 0);
    EXPECT_EQ(scene.joints[0].axes[kTurnX].upper, 1.5);
    ASSERT_EQ(scene.remarks.size(), 1u);
    expect_words(scene.remarks[0], "robot.urdf: joint \"ab\" starts at 0.5");
}

TEST_F(Robots, MotorsAimAtWhatTheUrdfCounts) {
    const std::string arm = link("a") + link("b") + link("c") + link("d") +
                            joint("revolute", "a", "b", kLimit) +
                            joint("prismatic", "b", "c", kLimit) + joint("continuous", "c", "d");
    RobotOptions options;
    options.positions = {{"ab", 0.5}, {"bc", 1}};
    options.hold = true;
    options.motors["ab"] = {MotorMode::position, 1.25, 7.0, 3, 0.5};
    options.motors["cd"] = {MotorMode::velocity, 2, std::nullopt, 5, 1};
    const Scene scene = scene_of(arm, options);

    const JointMotor& ab = scene.joints[0].axes[kTurnX].motor;
    EXPECT_EQ(ab.mode, MotorMode::position);
    EXPECT_DOUBLE_EQ(ab.target, 0.75);
    EXPECT_EQ(ab.greatest, 7);
    EXPECT_EQ(ab.damping_ratio, 0.5);
    const JointMotor& held = scene.joints[1].axes[kAlongX].motor;
    EXPECT_EQ(held.mode, MotorMode::position);
    EXPECT_EQ(held.target, 0);
    EXPECT_EQ(held.greatest, 30);
    const JointMotor& wheel = scene.joints[2].axes[kTurnX].motor;
    EXPECT_EQ(wheel.mode, MotorMode::velocity);
    EXPECT_EQ(wheel.target, 2);
    EXPECT_TRUE(std::isinf(wheel.greatest));
}

TEST_F(Robots, MotorsAnswerAsTheHeavierSideOfTheirJointFeels) {
    RobotOptions options;
    options.hold = true;
    const auto frequency = [&](const std::string& elements, JointAxis axis) {
        return scene_of(elements, options).joints[0].axes[axis].motor.frequency;
    };
    // A pendulum: 1 + 2 · 2² about the joint, 1 about its own centre.
    const std::string pendulum =
        "<link name='w'/><link name='b'>" + inertial("1 2 2.5", "2", "0 0 -2") + "</link>";
    EXPECT_NEAR(frequency(pendulum + joint("continuous", "w", "b"), kTurnX), 5 * 3, 1e-12);

    // A free trunk that weighs more on the joint, 1 + 2 · 1², than what hangs there.
    const std::string two = link("a") + link("b"), below = R"(<origin xyz="0 0 -1"/>)";
    EXPECT_NEAR(frequency(two + joint("continuous", "a", "b", below), kTurnX),
                5 * std::sqrt(3 * (1 + 1)), 1e-12);
    // With something more on the trunk: 1 + 2 · 1² + 1 + 2 · 2².
    const std::string head = link("c") + joint("continuous", "a", "c", R"(<origin xyz="0 0 1"/>)");
    EXPECT_NEAR(frequency(two + joint("continuous", "a", "b", below) + head, kTurnX),
                5 * std::sqrt(12 * (1 + 1)), 1e-12);

    EXPECT_NEAR(frequency(two + joint("prismatic", "a", "b", kLimit), kAlongX),
                5 * std::sqrt(2 * (0.5 + 0.5)), 1e-12);
}

TEST_F(Robots, MimicsAreCoupled) {
    const std::string hand =
        link("a") + link("b") + link("c") +
        joint("prismatic", "a", "c",
              kLimit + R"(<axis xyz="1 0 0"/><mimic joint="ab" multiplier="2" offset="0.25"/>)") +
        joint("revolute", "a", "b", kLimit);
    RobotOptions options;
    options.positions["ab"] = 0.5;
    options.hold = true;
    const Scene scene = scene_of(hand, options);
    expect_near(body(scene, "r/c").placement.position, {1.25, 0, 0});
    ASSERT_EQ(scene.couplings.size(), 1u);
    const CouplingSpec& tie = scene.couplings[0];
    EXPECT_EQ(scene.joints[tie.joint_a].name, "r/ab");
    EXPECT_EQ(scene.joints[tie.joint_b].name, "r/ac");
    EXPECT_EQ(tie.axis_a, kTurnX);
    EXPECT_EQ(tie.axis_b, kAlongX);
    EXPECT_EQ(tie.ratio, 2);
    EXPECT_NEAR(*tie.offset, 0, 1e-15);
    EXPECT_EQ(scene.joints[tie.joint_b].axes[kAlongX].motor.mode, MotorMode::none);
}

TEST_F(Robots, ARootWithoutMassIsTheWorld) {
    const std::string arm = R"(<link name="w"/>)" + link("a") + joint("continuous", "w", "a");
    const Scene scene = scene_of(arm);
    ASSERT_EQ(scene.bodies.size(), 1u);
    EXPECT_EQ(scene.joints[0].body_a, 0u);
    EXPECT_EQ(scene.joints[0].body_b, kNoIndex);

    RobotOptions options;
    options.base = RobotBase::fixed;
    const Scene fixed = scene_of(
        link("a", collision(R"(<sphere radius="1"/>)")) + link("b") + joint("continuous", "a", "b"),
        options);
    ASSERT_EQ(fixed.bodies.size(), 2u);
    EXPECT_EQ(fixed.bodies[0].motion, Motion::fixed);
    EXPECT_EQ(fixed.joints[0].body_b, 0u);
}

TEST_F(Robots, SelfCollisionCanBeOff) {
    const std::string arm = link("a") + link("b") + link("c") + joint("continuous", "a", "b") +
                            joint("continuous", "b", "c");
    EXPECT_TRUE(scene_of(arm).apart.empty());
    RobotOptions options;
    options.self_collision = false;
    const std::vector<std::array<std::uint32_t, 2>> wanted = {{0, 2}};  // no joint ties
    EXPECT_EQ(scene_of(arm, options).apart, wanted);
}

TEST_F(Robots, LinksThatOverlapAtTheStartDoNotCollide) {
    const std::string ball = collision(R"(<sphere radius="0.3"/>)");
    const std::string along = R"(<origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>)";
    const std::string arm = link("a", ball) + link("b", ball) + link("c", ball) +
                            joint("continuous", "a", "b", along) +
                            joint("continuous", "b", "c", along);
    const Scene straight = scene_of(arm);
    EXPECT_TRUE(straight.apart.empty());
    EXPECT_TRUE(straight.remarks.empty());

    // Bent by 2 rad, a and c are 2 · 0.5 · cos(1) = 0.54 apart.
    RobotOptions options;
    options.positions["ab"] = 2;
    const std::vector<std::array<std::uint32_t, 2>> wanted = {{0, 2}};
    const Scene bent = scene_of(arm, options);
    EXPECT_EQ(bent.apart, wanted);
    ASSERT_EQ(bent.remarks.size(), 1u);
    expect_words(bent.remarks[0], "do not collide: r/a and r/c");
}

TEST_F(Robots, LinksThatBeginInTheGroundDoNotCollideWithItWhereTheBaseIsFixed) {
    const std::string ball = collision(R"(<sphere radius="0.3"/>)");
    const std::string along = R"(<origin xyz="0 0 1"/><axis xyz="1 0 0"/>)";
    const std::filesystem::path file =
        write("robot.urdf",
              robot(link("a", ball) + link("b", ball) + link("c", ball) +
                    joint("continuous", "a", "b", along) + joint("continuous", "b", "c", along)));
    Scene ground;
    for (const ShapeKind kind : {ShapeKind::plane, ShapeKind::box}) {
        BodySpec body;
        body.name = kind == ShapeKind::plane ? "floor" : "block";
        body.motion = Motion::fixed;
        body.geometry = static_cast<std::uint32_t>(ground.geometries.size());
        body.placement.position = {0, kind == ShapeKind::plane ? 0.8 : 0.4, 0};
        Geometry shape;
        shape.kind = kind, shape.half_extents = {1, 0.4, 1};
        ground.geometries.push_back(shape);
        ground.bodies.push_back(body);
    }
    RobotOptions options;
    options.base = RobotBase::fixed;
    Scene held = ground;
    add_robot(held, file, options);
    const std::vector<std::array<std::uint32_t, 2>> wanted = {{0, 3}, {1, 3}};  // b alone
    EXPECT_EQ(held.apart, wanted);
    ASSERT_EQ(held.remarks.size(), 1u);
    expect_words(held.remarks[0], "do not collide with it: r/b and floor; r/b and block");

    options.base = RobotBase::free;
    Scene free = ground;
    add_robot(free, file, options);
    EXPECT_TRUE(free.apart.empty());
}

TEST_F(Robots, WithoutShapesAreToldOf) {
    const Scene bare = scene_of(link("a") + link("b") + joint("continuous", "a", "b"));
    ASSERT_EQ(bare.remarks.size(), 1u);
    expect_words(bare.remarks[0], "it collides with nothing");
}

TEST_F(Robots, VisualElementsAreNotRead) {
    const Scene scene = scene_of(
        R"(<material name="m"/>)" +
        link("a",
             R"(<visual><geometry><mesh filename="gone.dae"/></geometry><material/></visual>)"));
    EXPECT_TRUE(scene.geometries.empty());
    ASSERT_EQ(scene.remarks.size(), 1u);
    expect_words(scene.remarks[0], "none of its links has a shape that collides");
}

TEST_F(Robots, StandOnTheGroundWhenReadAlone) {
    const auto file =
        write("stander.urdf",
              robot(link("a", collision(R"(<box size="2 2 2"/>)",
                                        R"(<origin rpy="0.7853981633974483 0 0"/>)")) +
                    link("b", collision(R"(<cylinder radius="1" length="4"/>)",
                                        R"(<origin xyz="5 0 0" rpy="0 1.5707963267948966 0"/>)")) +
                    joint("continuous", "a", "b")));
    const Scene scene = read_scene(file);
    EXPECT_EQ(scene.name, "r");
    // The box stands on an edge, lower than the lying cylinder.
    EXPECT_NEAR(body(scene, "r/a").placement.position.y(), std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(body(scene, "r/b").placement.position.y(), std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(scene.joints[0].anchor.y(), std::sqrt(2.0), 1e-12);
    const BodySpec& ground = body(scene, "ground");
    EXPECT_EQ(ground.motion, Motion::fixed);
    EXPECT_EQ(scene.geometries[ground.geometry].kind, ShapeKind::plane);
    EXPECT_EQ(ground.placement.position.y(), 0);
}

TEST_F(Robots, AreTurnedByTheirPlacement) {
    RobotOptions options;
    options.placement.rotation = Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitY());
    const Scene scene = scene_of(
        link("a") + link("b") + joint("continuous", "a", "b", R"(<origin xyz="1 0 0"/>)"), options);
    expect_near(body(scene, "r/b").placement.position, {0, 0, -1});
}

}  // namespace plumb::test
