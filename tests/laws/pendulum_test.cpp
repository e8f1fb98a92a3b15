// SPDX-License-Identifier: MIT
/// A rod on a ball joint, and a chain: 1/60 s × 20 substeps × 1 iteration.
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class Pendulum : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(, Pendulum, testing::Values(Precision::single, Precision::double_),
                         [](const auto& which) {
                             return which.param == Precision::single ? "single" : "double";
                         });

TEST_P(Pendulum, ARodStaysOnItsJoint) {
    Scene s;
    use_fine_steps(s.settings);
    s.settings.precision = GetParam();
    add_body(s, box(0.5, 0.02, 0.02), {0.5, 0, 0});
    JointSpec joint;
    joint.body_a = 0;
    joint.anchor = Vector::Zero();
    s.joints.push_back(joint);
    Simulation simulation(s, colliders(), "reference");
    const double e0 = total_energy(simulation);
    double lowest = 0, widest = 0;
    const auto steps = std::llround(10 / s.settings.dt);
    for (long long i = 0; i < steps; ++i) {
        simulation.step();
        lowest = std::min(lowest, simulation.world().bodies.position[0].y());
        widest = std::max(widest, joint_errors(simulation.world())[0]);
        EXPECT_LE(total_energy(simulation),
                  e0 + 1e-3 * std::abs(simulation.world().bodies.mass[0] * 9.81))
            << i;
    }
    EXPECT_LT(widest, 1e-5) << "one joint is solved whole in each substep";
    EXPECT_NEAR(lowest, -0.5, 1e-3) << "it swings through the lowest point";
}

/// Widest joint gap of a chain of ten that falls from the horizontal [m].
double widest_gap(Precision precision, std::uint32_t iterations) {
    Scene s;
    use_fine_steps(s.settings);
    s.settings.precision = precision;
    s.settings.position_iterations = iterations;
    for (std::uint32_t i = 0; i < 10; ++i) {
        add_body(s, box(0.25, 0.05, 0.05), {0.25 + 0.5 * i, 0, 0});
        JointSpec joint;
        joint.body_a = i;
        joint.body_b = i == 0 ? kNoIndex : i - 1;
        joint.anchor = {0.5 * i, 0, 0};
        s.joints.push_back(joint);
    }
    Simulation simulation(s, colliders(), "reference");
    double widest = 0;
    const auto steps = std::llround(5 / s.settings.dt);
    for (long long i = 0; i < steps; ++i) {
        simulation.step();
        for (double e : joint_errors(simulation.world())) widest = std::max(widest, e);
    }
    return widest;
}

TEST_P(Pendulum, AChainClosesWithIterations) {
    const double few = widest_gap(GetParam(), 5), more = widest_gap(GetParam(), 20),
                 many = widest_gap(GetParam(), 80);
    std::cout << "widest gap: " << few * 1e3 << ", " << more * 1e3 << ", " << many * 1e3 << " mm\n";
    EXPECT_LT(more, 0.5 * few);
    EXPECT_LT(many, 0.25 * more);
    EXPECT_LT(many, 0.005) << "1 % of a link";
}

}  // namespace
}  // namespace plumb::test
