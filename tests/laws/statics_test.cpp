// SPDX-License-Identifier: MIT
/// Forces and torques in the joints of structures at rest, against statics, within 1 %: 1/60 s × 20
/// substeps, with trees solved exactly in 1 iteration and with all joints iterated in 10.
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

using StaticsCase = std::tuple<JointMethod, Precision>;
class Statics : public testing::TestWithParam<StaticsCase> {
protected:
    Statics() {
        use_fine_steps(s_.settings);
        s_.settings.joints = std::get<0>(GetParam());
        if (s_.settings.joints == JointMethod::iterate) s_.settings.position_iterations = 10;
        s_.settings.precision = std::get<1>(GetParam());
    }

    /// A bar in the plane of x and y, 0.1 m thick, which collides with nothing.
    std::uint32_t add_bar(const Vector& from, const Vector& to, double mass) {
        const Vector along = to - from;
        BodySpec& body = add_body(s_, box(0.5 * along.norm(), 0.05, 0.05), 0.5 * (from + to));
        body.placement.rotation = rotation_between(Vector::UnitX(), along);
        body.group = body.mask = 0;
        body.mass = mass;
        return static_cast<std::uint32_t>(s_.bodies.size()) - 1;
    }
    std::uint32_t add_joint(JointKind kind, std::uint32_t a, std::uint32_t b,
                            const Vector& anchor) {
        JointSpec joint;
        joint.kind = kind, joint.body_a = a, joint.body_b = b, joint.anchor = anchor;
        if (kind == JointKind::hinge)  // about z
            joint.frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
        s_.joints.push_back(joint);
        return static_cast<std::uint32_t>(s_.joints.size()) - 1;
    }

    /// Loads on a from b, the mean of the last tenth of a second after two at rest.
    std::vector<JointLoad> settle(const std::string& collider = "reference") {
        Simulation simulation(s_, colliders(), collider);
        run_for(simulation, 2);
        std::vector<JointLoad> mean(s_.joints.size(), {Vector::Zero(), Vector::Zero()});
        for (int i = 0; i < 6; ++i) {
            simulation.step();
            for (std::uint32_t k = 0; k < mean.size(); ++k) {
                mean[k].force += simulation.joint_load(k).force / 6;
                mean[k].torque += simulation.joint_load(k).torque / 6;
            }
        }
        for (const Vector& v : simulation.world().bodies.velocity) EXPECT_LT(v.norm(), 1e-3);
        return mean;
    }
    static void expect_near(const Vector& is, const Vector& should, double scale,
                            const std::string& what) {
        EXPECT_LT((is - should).norm(), 0.01 * scale)
            << what << " is " << is.transpose() << ", should be " << should.transpose();
    }

    Scene s_;
};
std::string statics_case_name(const testing::TestParamInfo<StaticsCase>& info) {
    return std::string(std::get<0>(info.param) == JointMethod::tree ? "tree" : "iterated") + "_" +
           word_of(std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(, Statics,
                         testing::Combine(testing::Values(JointMethod::tree, JointMethod::iterate),
                                          each_precision()),
                         statics_case_name);

/// Five bars of 10 kg and 0.5 m, fixed to each other and to a wall, with 200 N at the end.
TEST_P(Statics, ACantileverBearsItsEndLoadAtEachJoint) {
    constexpr int kBars = 5;
    constexpr double kLength = 0.5, kMass = 10, kLoad = 200;
    for (int i = 0; i < kBars; ++i) {
        const std::uint32_t bar = add_bar({kLength * i, 0, 0}, {kLength * (i + 1), 0, 0}, kMass);
        add_joint(JointKind::fixed, bar, i == 0 ? kNoIndex : bar - 1, {kLength * i, 0, 0});
    }
    // at the end of the bar: at its centre, and what that lacks of the moment
    s_.bodies.back().force = {0, -kLoad, 0};
    s_.bodies.back().torque = {0, 0, -kLoad * 0.5 * kLength};
    const std::vector<JointLoad> loads = settle();
    for (int i = 0; i < kBars; ++i) {
        const double n = kBars - i, out = kLength * n;
        const double shear = n * kMass * kGravity + kLoad,
                     moment = n * kMass * kGravity * 0.5 * out + kLoad * out;
        const JointLoad& load = loads[static_cast<std::size_t>(i)];
        expect_near(load.force, {0, shear, 0}, shear, "force " + std::to_string(i));
        expect_near(load.torque, {0, 0, moment}, moment, "torque " + std::to_string(i));
    }
}

/// Two bars of a roof, hinged to the ground and to each other, with a load at the ridge: a thrust
/// of (P + W)/2 times the tangent of the half angle, W a bar's weight.
TEST_P(Statics, AThreeHingedArchThrustsOutwards) {
    constexpr double kHalfSpan = 1, kHeight = 1.5, kMass = 20, kLoad = 500;
    const Vector left(-kHalfSpan, 0, 0), right(kHalfSpan, 0, 0), ridge(0, kHeight, 0);
    const std::uint32_t a = add_bar(left, ridge, kMass), b = add_bar(right, ridge, kMass);
    const std::uint32_t at_left = add_joint(JointKind::hinge, a, kNoIndex, left),
                        at_right = add_joint(JointKind::hinge, b, kNoIndex, right),
                        at_ridge = add_joint(JointKind::hinge, a, b, ridge);
    // on a alone, at the ridge: at its centre with the moment about it
    s_.bodies[a].force = {0, -kLoad, 0};
    s_.bodies[a].torque = (0.5 * (ridge - left)).cross(Vector(0, -kLoad, 0));
    const std::vector<JointLoad> loads = settle();
    const double weight = kMass * kGravity, up = weight + 0.5 * kLoad,
                 thrust = 0.5 * (weight + kLoad) * kHalfSpan / kHeight;
    const double scale = std::hypot(up, thrust);
    expect_near(loads[at_left].force, {thrust, up, 0}, scale, "left");
    expect_near(loads[at_right].force, {-thrust, up, 0}, scale, "right");
    expect_near(loads[at_ridge].force, {-thrust, 0.5 * kLoad, 0}, scale, "ridge");
}

/// A beam of 2 m on a hinge and on a roller, a point held at its height, with a load a quarter of
/// the way along it.
TEST_P(Statics, ABridgeSharesItsLoadByTheLever) {
    constexpr double kSpan = 2, kMass = 50, kLoad = 1000, kShare = 0.25;
    const std::uint32_t beam = add_bar({0, 1, 0}, {kSpan, 1, 0}, kMass);
    const std::uint32_t pin = add_joint(JointKind::hinge, beam, kNoIndex, {0, 1, 0}),
                        roller =
                            add_joint(JointKind::point_on_plane, beam, kNoIndex, {kSpan, 1, 0});
    s_.joints[roller].frame = rotation_between(Vector::UnitX(), Vector::UnitY());
    s_.bodies[beam].force = {0, -kLoad, 0};
    s_.bodies[beam].torque = Vector((kShare - 0.5) * kSpan, 0, 0).cross(Vector(0, -kLoad, 0));
    const std::vector<JointLoad> loads = settle();
    const double weight = kMass * kGravity, scale = weight + kLoad;
    expect_near(loads[pin].force, {0, 0.5 * weight + (1 - kShare) * kLoad, 0}, scale, "pin");
    expect_near(loads[roller].force, {0, 0.5 * weight + kShare * kLoad, 0}, scale, "roller");
}

/// A wall bracket of two bars: the upper one level, the lower one a strut at 45°, with a load where
/// they meet. Each bar's weight goes half to either end.
TEST_P(Statics, ABracketPullsAboveAndPushesBelow) {
    constexpr double kReach = 1.2, kMass = 5, kLoad = 800;
    const Vector top(0, kReach, 0), bottom(0, 0, 0), tip(kReach, kReach, 0);
    const std::uint32_t tie = add_bar(top, tip, kMass), strut = add_bar(bottom, tip, kMass);
    const std::uint32_t at_top = add_joint(JointKind::hinge, tie, kNoIndex, top),
                        at_bottom = add_joint(JointKind::hinge, strut, kNoIndex, bottom);
    add_joint(JointKind::hinge, tie, strut, tip);
    s_.bodies[tie].force = {0, -kLoad, 0};
    s_.bodies[tie].torque = (0.5 * (tip - top)).cross(Vector(0, -kLoad, 0));
    const std::vector<JointLoad> loads = settle();
    const double weight = kMass * kGravity, at_tip = kLoad + weight;  // halves of two bars
    const double scale = std::hypot(at_tip, at_tip + 0.5 * weight);
    expect_near(loads[at_top].force, {-at_tip, 0.5 * weight, 0}, scale, "top");
    expect_near(loads[at_bottom].force, {at_tip, at_tip + 0.5 * weight, 0}, scale, "bottom");
}

/// Three bars hung from a ceiling, each from the middle of the one above by a ball, and two more
/// from the ends of the last.
TEST_P(Statics, AHungStructureBearsAllThatHangsBelow) {
    const double masses[5] = {1, 30, 4, 7, 7};
    for (std::uint32_t i = 0; i < 5; ++i) {
        const double x = i < 3 ? 0 : i == 3 ? -0.5 : 0.5, y = i < 4 ? -1.0 * i : -3;
        add_bar({x - 0.5, y, 0}, {x + 0.5, y, 0}, masses[i]);
        const std::uint32_t above = i == 0 ? kNoIndex : std::min(i - 1, 2u);
        add_joint(i == 0 ? JointKind::fixed : JointKind::ball, i, above, {x, y + 0.2, 0});
    }
    const std::vector<JointLoad> loads = settle();
    const double hung[5] = {49, 48, 18, 7, 7};
    for (std::size_t i = 0; i < 5; ++i)
        expect_near(loads[i].force, {0, hung[i] * kGravity, 0}, hung[i] * kGravity,
                    "joint " + std::to_string(i));
}

/// A slab that juts out from the world, held at one end, and a box that rests on it.
class LoadedSlab : public OnEveryCollider {
protected:
    /// Expects the joint to bear both weights and their moments; body 0 is the slab, 1 the box.
    void expect_bears(const JointSpec& holding) {
        constexpr double kSlab = 20, kBox = 40, kReach = 1, kAt = 0.7;
        Scene s = scene();
        use_fine_steps(s.settings);
        add_body(s, box(0.5 * kReach, 0.05, 0.3), {0.5 * kReach, 1, 0}).mass = kSlab;
        add_body(s, box(0.1, 0.1, 0.1), {kAt, 1.15, 0}).mass = kBox;
        s.joints = {holding};
        s.joints[0].body_a = 0, s.joints[0].anchor = {0, 1, 0};
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 2);
        const double force = (kSlab + kBox) * kGravity,
                     moment = (kSlab * 0.5 * kReach + kBox * kAt) * kGravity;
        for (int i = 0; i < 10; ++i) {
            simulation.step();
            const JointLoad load = simulation.joint_load(0);
            EXPECT_LT((load.force - Vector(0, force, 0)).norm(), 0.01 * force)
                << load.force.transpose();
            EXPECT_LT((load.torque - Vector(0, 0, moment)).norm(), 0.01 * moment)
                << load.torque.transpose();
        }
        EXPECT_NEAR(simulation.world().bodies.position[1].y(), 1.15, 2e-3);
    }
    static JointSpec hinge() {
        JointSpec joint;
        joint.kind = JointKind::hinge;
        joint.frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
        return joint;
    }
};
INSTANTIATE_TEST_SUITE_P(, LoadedSlab, every_collider(), where_name);

TEST_P(LoadedSlab, IsBorneByAFixedJoint) {
    JointSpec joint;
    joint.kind = JointKind::fixed;
    expect_bears(joint);
}

TEST_P(LoadedSlab, IsBorneByAHingeAtItsLimit) {
    JointSpec joint = hinge();
    joint.axes[kTurnX].lower = 0;
    expect_bears(joint);
}

TEST_P(LoadedSlab, IsBorneByAMotor) {
    JointSpec joint = hinge();
    joint.axes[kTurnX].motor.mode = MotorMode::position;
    joint.axes[kTurnX].motor.frequency = 60;
    joint.axes[kTurnX].motor.greatest = 1000;
    expect_bears(joint);
}

}  // namespace
}  // namespace plumb::test
