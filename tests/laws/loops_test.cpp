// SPDX-License-Identifier: MIT
/// Closed loops of hinges and sliders, driven by a crank for 60 s: 1/60 s × 20 substeps × 10
/// iterations. All hinges are given in full, so every planar loop has three rows too many.
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

struct Bar {
    Vector from, to;
};

class Loops : public InEachPrecision {
protected:
    Loops() {
        use_fine_steps(s_.settings);
        s_.settings.position_iterations = 10;
        s_.settings.precision = GetParam();
    }

    /// A bar in the plane of x and y, which collides with nothing.
    std::uint32_t add_bar(const Bar& bar) {
        const Vector along = bar.to - bar.from;
        BodySpec& body =
            add_body(s_, box(0.5 * along.norm(), 0.04, 0.04), 0.5 * (bar.from + bar.to));
        body.placement.rotation = rotation_between(Vector::UnitX(), along);
        body.group = body.mask = 0;
        return static_cast<std::uint32_t>(s_.bodies.size()) - 1;
    }
    JointSpec& add_joint(JointKind kind, std::uint32_t a, std::uint32_t b, const Vector& anchor,
                         const Vector& axis) {
        JointSpec joint;
        joint.kind = kind, joint.body_a = a, joint.body_b = b, joint.anchor = anchor;
        joint.frame = rotation_between(Vector::UnitX(), axis);
        s_.joints.push_back(joint);
        return s_.joints.back();
    }
    JointSpec& add_hinge(std::uint32_t a, std::uint32_t b, const Vector& anchor) {
        return add_joint(JointKind::hinge, a, b, anchor, Vector::UnitZ());
    }
    void drive(JointSpec& hinge, double speed) {
        hinge.axes[kTurnX].motor.mode = MotorMode::velocity;
        hinge.axes[kTurnX].motor.target = speed;
        hinge.axes[kTurnX].motor.greatest = 200;
    }
    void expect_holds(double turns) {
        Simulation simulation(s_, colliders(), "reference");
        double parted = 0, turned = 0;
        for (int i = 0; i < 3600; ++i) {
            ASSERT_TRUE(simulation.step().finite);
            for (double e : joint_errors(simulation.world())) parted = std::max(parted, e);
            for (double e : joint_turn_errors(simulation.world())) turned = std::max(turned, e);
        }
        EXPECT_LT(parted, 1e-5);
        EXPECT_LT(turned, 1e-4);
        EXPECT_NEAR(simulation.joint_motion(0, kTurnX).position / (2 * std::numbers::pi), turns,
                    0.01 * turns);
    }

    Scene s_;
};
INSTANTIATE_TEST_SUITE_P(, Loops, each_precision(), precision_name);

TEST_P(Loops, AFourBarHolds) {
    const Vector a(0, 0, 0), b(0, 0.3, 0), c(1.1, 0.8, 0), d(1, 0, 0);
    const std::uint32_t crank = add_bar({a, b}), coupler = add_bar({b, c}),
                        rocker = add_bar({d, c});
    drive(add_hinge(crank, kNoIndex, a), 2);
    add_hinge(coupler, crank, b);
    add_hinge(coupler, rocker, c);
    add_hinge(rocker, kNoIndex, d);
    expect_holds(60 * 2 / (2 * std::numbers::pi));
}

TEST_P(Loops, ASliderCrankTurnsThroughItsDeadPoints) {
    const Vector a(0, 0, 0), b(0.4, 0, 0), c(1.4, 0, 0);  // it starts in one
    const std::uint32_t crank = add_bar({a, b}), rod = add_bar({b, c});
    add_body(s_, box(0.1, 0.1, 0.1), c).group = 0;
    drive(add_hinge(crank, kNoIndex, a), 3);
    add_hinge(rod, crank, b);
    add_hinge(2, rod, c);
    add_joint(JointKind::slider, 2, kNoIndex, c, Vector::UnitX());
    expect_holds(60 * 3 / (2 * std::numbers::pi));
}

/// Three equal cranks on one coupler: one more than it needs. Their pivots are not in line, so that
/// no pose leaves the coupler a choice.
TEST_P(Loops, AParallelogramWithACrankTooManyHolds) {
    const Vector up(0, 0.4, 0), pivots[3] = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.6, 0}};
    std::uint32_t cranks[3];
    for (int i = 0; i < 3; ++i) cranks[i] = add_bar({pivots[i], pivots[i] + up});
    const std::uint32_t coupler = add_bar({pivots[0] + up, pivots[1] + up});
    drive(add_hinge(cranks[0], kNoIndex, pivots[0]), 2);
    for (int i = 1; i < 3; ++i) add_hinge(cranks[i], kNoIndex, pivots[i]);
    for (int i = 0; i < 3; ++i) add_hinge(coupler, cranks[i], pivots[i] + up);
    expect_holds(60 * 2 / (2 * std::numbers::pi));
}

}  // namespace
}  // namespace plumb::test
