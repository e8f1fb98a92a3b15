// SPDX-License-Identifier: MIT
/// A rod on a ball joint, and a chain: 1/60 s × 20 substeps × 1 iteration.
#include "support/pendulum.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

namespace plumb::test {
namespace {

class Pendulum : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, Pendulum, each_precision(), precision_name);

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

/// Period of a rod of 1 m let go at 90°, in 1/60 s × n substeps of one iteration [s].
double period_of_rod(Precision precision, std::uint32_t substeps) {
    Scene s;
    use_fine_steps(s.settings);
    s.settings.substeps = substeps;
    s.settings.precision = precision;
    add_body(s, box(0.5, 0.02, 0.02), {0.5, 0, 0});
    JointSpec joint;
    joint.body_a = 0;
    s.joints.push_back(joint);
    Simulation simulation(s, colliders(), "reference");
    PeriodWatch watch;
    while (simulation.time() < 10) {
        simulation.step();
        watch.see(simulation.time(), s.settings.dt, simulation.world().bodies.position[0].x());
    }
    return watch.period();
}

/// T = 2π √(I/(m g l)) times the lengthening at 90°; I about the joint.
TEST_P(Pendulum, ARodSwingsInItsPeriod) {
    const double about_joint = 1.0 / 3 + 0.02 * 0.02 / 3;  // I/m [m²]
    const double exact = 2 * std::numbers::pi * std::sqrt(about_joint / (9.81 * 0.5)) *
                         lengthening(std::numbers::pi / 2);
    double errors[3];
    const std::uint32_t substeps[3] = {5, 10, 20};
    for (int i = 0; i < 3; ++i)
        errors[i] = std::abs(period_of_rod(GetParam(), substeps[i]) / exact - 1);
    std::cout << "error of the period: " << errors[0] << ", " << errors[1] << ", " << errors[2]
              << " at 5, 10, 20 substeps\n";
    EXPECT_LT(errors[2], 1e-3);
    EXPECT_GT(std::log2(errors[0] / errors[1]), 0.9);
}

/// Two rods of length 1 on the world, let go at 90° and at rest: angles from the vertical after a
/// time by Runge and Kutta's fourth order at tiny steps.
struct TwoAngles {
    double q[2], w[2];
};
TwoAngles exact_double_pendulum(double time) {
    const double inertia = (1 + 0.02 * 0.02) / 12 + 0.02 * 0.02 / 4, g = 9.81;  // of a rod over m
    const auto rate = [&](const TwoAngles& s) {
        // Lagrange: M q″ = f with both rods of mass 1, centres at half length
        const double c = std::cos(s.q[0] - s.q[1]), sine = std::sin(s.q[0] - s.q[1]);
        const double m00 = inertia + 0.25 + 1, m11 = inertia + 0.25, m01 = 0.5 * c;
        const double f0 = -0.5 * sine * s.w[1] * s.w[1] - 1.5 * g * std::sin(s.q[0]);
        const double f1 = 0.5 * sine * s.w[0] * s.w[0] - 0.5 * g * std::sin(s.q[1]);
        const double det = m00 * m11 - m01 * m01;
        return TwoAngles{{s.w[0], s.w[1]},
                         {(m11 * f0 - m01 * f1) / det, (m00 * f1 - m01 * f0) / det}};
    };
    const auto plus = [](const TwoAngles& s, const TwoAngles& d, double h) {
        TwoAngles r = s;
        for (int i = 0; i < 2; ++i) r.q[i] += h * d.q[i], r.w[i] += h * d.w[i];
        return r;
    };
    TwoAngles s{{std::numbers::pi / 2, std::numbers::pi / 2}, {0, 0}};
    const int steps = 20000;
    const double h = time / steps;
    for (int i = 0; i < steps; ++i) {
        const TwoAngles k1 = rate(s), k2 = rate(plus(s, k1, h / 2)), k3 = rate(plus(s, k2, h / 2)),
                        k4 = rate(plus(s, k3, h));
        s = plus(plus(plus(plus(s, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
    }
    return s;
}

TEST_P(Pendulum, TwoRodsSwingAsTheirEquationsSay) {
    const TwoAngles exact = exact_double_pendulum(2);
    const Vector tip(std::sin(exact.q[0]) + std::sin(exact.q[1]),
                     -std::cos(exact.q[0]) - std::cos(exact.q[1]), 0);
    double errors[3];
    const std::uint32_t substeps[3] = {20, 40, 80};
    for (int i = 0; i < 3; ++i) {
        Scene s;
        use_fine_steps(s.settings);
        s.settings.substeps = substeps[i], s.settings.position_iterations = 10;
        s.settings.precision = GetParam();
        for (std::uint32_t k = 0; k < 2; ++k) {
            add_body(s, box(0.5, 0.02, 0.02), {0.5 + k, 0, 0});
            JointSpec joint;
            joint.body_a = k, joint.body_b = k == 0 ? kNoIndex : 0;
            joint.anchor = {double(k), 0, 0};
            s.joints.push_back(joint);
        }
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 2);
        const Bodies& b = simulation.world().bodies;
        errors[i] = (b.position[1] + b.orientation[1] * Vector(0.5, 0, 0) - tip).norm();
    }
    std::cout << "the tip is off by " << errors[0] << ", " << errors[1] << ", " << errors[2]
              << " m at 20, 40, 80 substeps\n";
    EXPECT_LT(errors[0], 0.005 * 2);
    EXPECT_GT(std::log2(errors[0] / errors[2]) / 2, 0.9);
}

/// Widest joint gap of a chain of ten that falls from the horizontal [m].
double widest_gap(Precision precision, std::uint32_t iterations) {
    Scene s;
    use_fine_steps(s.settings);
    s.settings.precision = precision;
    s.settings.joints = JointMethod::iterate;
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
