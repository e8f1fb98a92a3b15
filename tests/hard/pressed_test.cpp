// SPDX-License-Identifier: MIT
/// Joints between a heavy load and the ground: contacts tear them open again and again. They come
/// together again, and no faster than Settings::recovery_speed allows.
#include "measure/measure.h"
#include "support/scenes.h"

#include <algorithm>

namespace plumb::test {
namespace {

/// Three boxes of 1 kg, hinged one on top of the other within ±0.5 rad, and a ton that falls on
/// them.
Scene pressed_figure(Precision precision) {
    Scene s;
    s.settings.precision = precision;
    s.settings.joints = JointMethod::tree;
    s.settings.dt = 0.01, s.settings.substeps = 4;
    add_ground(s);
    const double x[3] = {0, 0.02, 0}, z[3] = {0, 0, 0.013};
    for (std::uint32_t i = 0; i < 3; ++i)
        add_body(s, box(0.06, 0.1, 0.06), {x[i], 0.1 + 0.201 * i, z[i]}).mass = 1;
    add_body(s, box(0.5, 0.1, 0.5), {0, 0.9, 0}).mass = 1000;
    for (std::uint32_t i = 0; i < 2; ++i) {
        JointSpec hinge;
        hinge.kind = JointKind::hinge;
        hinge.body_a = i + 2, hinge.body_b = i + 1;
        hinge.anchor = {0, 0.2 * (i + 1), 0};
        hinge.frame = Eigen::AngleAxisd(-1.5707963267948966, Vector::UnitY());
        hinge.axes[kTurnX].lower = -0.5, hinge.axes[kTurnX].upper = 0.5;
        s.joints.push_back(hinge);
    }
    return s;
}

double widest_error(const Simulation& s) {
    const std::vector<double> errors = joint_errors(s.world());
    return *std::max_element(errors.begin(), errors.end());
}

class Pressed : public testing::TestWithParam<Where> {};
INSTANTIATE_TEST_SUITE_P(, Pressed, every_collider(), where_name);

TEST_P(Pressed, AFigureUnderATonStaysTogether) {
    const auto [collider, precision] = GetParam();
    Simulation simulation(pressed_figure(precision), colliders(), collider);
    const double start = total_energy(simulation);
    double widest = 0, most = start;
    for (int i = 0; i < 500; ++i) {
        ASSERT_TRUE(simulation.step().finite) << i;
        widest = std::max(widest, widest_error(simulation));
        most = std::max(most, total_energy(simulation));
    }
    EXPECT_LT(widest, 0.2) << "no link is longer";
    // two contacts and two joints in a row recover at the most at this speed together
    const double lift = 4 * simulation.world().settings.recovery_speed;
    EXPECT_LT(most, start + 0.5 * 1003 * lift * lift);
    EXPECT_LT(total_energy(simulation), start);
    EXPECT_LT(widest_error(simulation), 0.01) << "it lies and bears the load";
}

}  // namespace
}  // namespace plumb::test
