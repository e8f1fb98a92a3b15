// SPDX-License-Identifier: MIT
/// Links and attachments: rods, strings and springs between particles, bodies and the world.
#include "support/pendulum.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/soft.h"

#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class Links : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, Links, each_precision(), precision_name);

Scene airy(Precision precision) {
    Scene s;
    s.settings.precision = precision;
    s.settings.forbid = {"contacts"};
    return s;
}

/// Two particles of 1 kg that hardly feel each other: the first at `held`, where it stays, the
/// other at `free`.
DeformableSpec loose_particles(const Vector& held, const Vector& free) {
    DeformableSpec spec = rope(held, free, 1);
    spec.elasticity.youngs_modulus = 1e-6;
    spec.mass = 2;
    return spec;
}

/// One particle on a rod of 1 m from the origin, let go at an angle [rad].
Scene particle_on_a_rod(Precision precision, double angle) {
    Scene s = airy(precision);
    const Vector at(std::sin(angle), -std::cos(angle), 0);
    add_soft(s, loose_particles({0, 0, 1}, at));
    hold(s, 0, {0});
    add_link(s, point_of(0, 1), in_the_world(Vector::Zero()));
    return s;
}

TEST_P(Links, ARodKeepsItsSwingsEnergyForAMinute) {
    for (const bool fine : {false, true}) {
        Scene s = particle_on_a_rod(GetParam(), std::numbers::pi / 6);
        if (fine) use_fine_steps(s.settings);
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        const auto energy = [&] {
            return 0.5 * world.particles.velocity[1].squaredNorm() +
                   9.81 * (1 + world.particles.position[1].y());
        };
        double first = 0, last = 0, stretch = 0;
        int of_first = 0, of_last = 0;
        while (simulation.time() < 60) {
            simulation.step();
            if (simulation.time() < 6) first += energy(), ++of_first;
            if (simulation.time() > 54) last += energy(), ++of_last;
            stretch = std::max(stretch, std::abs(world.particles.position[1].norm() - 1));
        }
        const double left = (last / of_last) / (first / of_first);
        std::cout << (fine ? "fine" : "coarse") << ": energy " << left << ", length off by "
                  << stretch << "\n";
        EXPECT_GT(left, 0.99) << (fine ? "fine" : "coarse");
        EXPECT_LT(left, 1.01) << (fine ? "fine" : "coarse");
        EXPECT_LT(stretch, 1e-4);
    }
}

TEST_P(Links, ARodHasItsPeriod) {
    for (const double angle : {0.1, std::numbers::pi / 6, 1.0})
        for (const bool fine : {false, true}) {
            Scene s = particle_on_a_rod(GetParam(), angle);
            if (fine) use_fine_steps(s.settings);
            Simulation simulation(s, colliders(), "reference");
            PeriodWatch watch;
            while (simulation.time() < 30) {
                simulation.step();
                watch.see(simulation.time(), s.settings.dt,
                          simulation.world().particles.position[1].x());
            }
            const double exact = 2 * std::numbers::pi * std::sqrt(1 / 9.81) * lengthening(angle);
            std::cout << angle << (fine ? " fine: " : " coarse: ") << watch.period() / exact - 1
                      << "\n";
            EXPECT_NEAR(watch.period() / exact, 1, 0.001) << angle << (fine ? " fine" : " coarse");
        }
}

/// A mass under a spring with a dashpot moves as implicit Euler says, bit by bit.
TEST_P(Links, ASpringWithADashpotIsImplicitEulers) {
    Random random(3);
    for (int draw = 0; draw < 20; ++draw) {
        Scene s = airy(GetParam());
        s.settings.dt = random.number(0.001, 0.02);
        s.settings.substeps = 1 + random.below(8);
        s.settings.position_iterations = 1 + random.below(4);
        add_soft(s, loose_particles({0, 0, 1}, {0, -1, 0}));
        hold(s, 0, {0});
        LinkSpec& spring = add_link(s, point_of(0, 1), in_the_world(Vector::Zero()));
        const double k = std::pow(10, random.number(0, 4)),
                     c = draw % 2 == 0 ? 0 : random.number(0, 2) * std::sqrt(k);
        spring.compliance = 1 / k, spring.damping = c;
        Simulation simulation(s, colliders(), "reference");
        const double h = s.settings.dt / s.settings.substeps;
        double x = 0, v = 0, worst = 0, size = 0;
        for (int i = 0; i < 100; ++i) {
            simulation.step();
            for (std::uint32_t j = 0; j < s.settings.substeps; ++j) {
                v -= 9.81 * h;
                v = (v - h * k * x) / (1 + h * c + h * h * k);
                x += h * v;
            }
            worst = std::max(worst, std::abs(simulation.world().particles.position[1].y() + 1 - x));
            size = std::max(size, std::abs(x));
        }
        EXPECT_LT(worst, (GetParam() == Precision::single ? 1e-4 : 1e-9) * size)
            << k << " N/m, " << c << " N s/m, h " << h;
    }
}

/// Frequency and decay: ω√(1 − ζ²) and e^{−ζωt}, in steps that resolve them.
TEST_P(Links, ASpringWithADashpotHasItsFrequencyAndDecay) {
    for (const double zeta : {0.05, 0.2}) {
        const double omega = 5;
        Scene s = airy(GetParam());
        s.settings.gravity.setZero();
        s.settings.dt = 0.001, s.settings.substeps = 10;
        add_soft(s, loose_particles({0, 0, 1}, {0, -1, 0}));
        hold(s, 0, {0});
        s.deformables[0].velocity = {0, 0.5, 0};
        LinkSpec& spring = add_link(s, point_of(0, 1), in_the_world(Vector::Zero()));
        spring.compliance = 1 / (omega * omega), spring.damping = 2 * zeta * omega;
        Simulation simulation(s, colliders(), "reference");
        PeriodWatch watch;
        while (simulation.time() < 3) {
            simulation.step();
            const double t = simulation.time(), damped = omega * std::sqrt(1 - zeta * zeta),
                         x = simulation.world().particles.position[1].y() + 1;
            watch.see(t, s.settings.dt, x);
            EXPECT_NEAR(x, 0.5 / damped * std::exp(-zeta * omega * t) * std::sin(damped * t),
                        0.0005);
        }
        EXPECT_NEAR(watch.period() * omega * std::sqrt(1 - zeta * zeta) / (2 * std::numbers::pi), 1,
                    0.002);
    }
}

/// A string with a longest length alone: free flight while it is slack, then no further.
TEST_P(Links, AStringIsSlackUntilItIsTaut) {
    for (const bool fine : {false, true}) {
        Scene s = airy(GetParam());
        if (fine) use_fine_steps(s.settings);
        add_soft(s, loose_particles({0, 0, 1}, {0, -0.5, 0}));
        hold(s, 0, {0});
        add_link(s, point_of(0, 1), in_the_world(Vector::Zero())).longest = 1;
        Simulation simulation(s, colliders(), "reference");
        const double taut = std::sqrt(2 * 0.5 / 9.81);
        const double h = s.settings.dt / s.settings.substeps;
        while (simulation.time() < 2) {
            simulation.step();
            const double t = simulation.time(), y = simulation.world().particles.position[1].y();
            if (t < taut - s.settings.dt) {
                EXPECT_NEAR(y, -0.5 - 0.5 * 9.81 * t * (t + h), 1e-5);
            }
            EXPECT_GT(y, -1 - 1e-5);
            if (t > taut + s.settings.dt) {
                EXPECT_NEAR(y, -1, 1e-5) << "nothing bounces";
            }
        }
        // the force of the last substep is the weight
        EXPECT_NEAR(simulation.world().links[0].impulse.y() / h, 9.81, 1e-3);
    }
}

/// A prop with a shortest length alone pushes and does not pull.
TEST_P(Links, APropPushesAndDoesNotPull) {
    Scene s = airy(GetParam());
    add_soft(s, loose_particles({0, 0, 1}, {0, 1.2, 0}));
    hold(s, 0, {0});
    add_link(s, point_of(0, 1), in_the_world(Vector::Zero())).shortest = 1;
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 2);
    EXPECT_NEAR(simulation.world().particles.position[1].y(), 1, 1e-5);
    Scene up = s;
    up.settings.gravity = {0, 1, 0};
    Simulation flying(up, colliders(), "reference");
    run_for(flying, 1);
    EXPECT_NEAR(flying.world().particles.position[1].y(), 1.2 + 0.5 * 1 * 1.01, 1e-5);
}

/// Points on a body that is moved by a script are where the body has them.
TEST_P(Links, WhatIsAttachedToAScriptedBodyFollowsIt) {
    for (const bool fine : {false, true}) {
        Scene s = airy(GetParam());
        if (fine) use_fine_steps(s.settings);
        BodySpec& plate = add_body(s, box(0.5, 0.05, 0.5), {0, 0, 0}, Motion::kinematic);
        plate.velocity = {0.3, 0.1, 0}, plate.angular_velocity = {0, 2, 1};
        DeformableSpec& cloth = add_soft(s, sheet({4, 4}, {0.8, 0.8}, {0, 0.05, 0}));
        cloth.elasticity.youngs_modulus = 1e5;
        hold(s, 0, {0, 4, 20, 24}, 0);
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        double worst = 0;
        while (simulation.time() < 2) {
            simulation.step();
            for (const std::uint32_t p : {0u, 4u, 20u, 24u}) {
                const Vector there = world.bodies.position[0] +
                                     world.bodies.orientation[0] * s.deformables[0].points[p];
                worst = std::max(worst, (world.particles.position[p] - there).norm());
            }
        }
        std::cout << (fine ? "fine: " : "coarse: ") << worst << "\n";
        EXPECT_LT(worst, 1e-4) << (fine ? "fine" : "coarse");
    }
}

/// A rope between two free bodies: it follows both, and what it does to them sums up to nothing.
TEST_P(Links, WhatIsAttachedToFreeBodiesPullsThem) {
    for (const bool fine : {false, true}) {
        Scene s = airy(GetParam());
        if (fine) use_fine_steps(s.settings);
        s.settings.gravity.setZero();
        add_body(s, box(0.1, 0.2, 0.15), {-1, 0, 0}).velocity = {-1, 0.5, 0};
        add_body(s, sphere(0.15), {1, 0, 0}).angular_velocity = {0, 0, 3};
        DeformableSpec& string = add_soft(s, rope({-0.9, 0, 0}, {0.85, 0, 0}, 10));
        string.mass = 1, string.thickness = 0.005;
        hold(s, 0, {0}, 0);
        hold(s, 0, {10}, 1);
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        const Vector p0 = linear_momentum(world), l0 = angular_momentum(world);
        const double v0 = world.bodies.velocity[1].norm();
        double worst = 0;
        while (simulation.time() < 3) {
            simulation.step();
            const auto gap = [&](std::uint32_t body, std::uint32_t p, const Vector& arm) {
                const Vector there =
                    world.bodies.position[body] + world.bodies.orientation[body] * arm;
                worst = std::max(worst, (world.particles.position[p] - there).norm());
            };
            gap(0, 0, {0.1, 0, 0});
            gap(1, 10, {-0.15, 0, 0});
        }
        std::cout << (fine ? "fine: " : "coarse: ") << worst << "\n";
        EXPECT_LT(worst, 2e-3);
        EXPECT_GT(world.bodies.velocity[1].norm(), v0 + 0.1) << "it is pulled along";
        const double bound = GetParam() == Precision::single ? 1e-5 : 1e-10;
        EXPECT_LT((linear_momentum(world) - p0).norm() / p0.norm(), bound);
        EXPECT_LT((angular_momentum(world) - l0).norm() / l0.norm(), bound);
    }
}

/// A heavy box on a light string, tied to its middle, swings like a point on a rod. Steps that
/// carry a load a hundred times the string's along it.
TEST_P(Links, ABoxOnAStringSwingsWithThePeriodOfAPendulum) {
    Random random(9);
    for (int draw = 0; draw < 10; ++draw) {
        Scene s = airy(GetParam());
        s.settings.dt = random.number(0.002, 0.0167);
        s.settings.substeps = 10 + random.below(20);
        s.settings.position_iterations = 6 + random.below(6);
        const bool of_links = draw % 2 == 1;
        const double angle = random.number(0.05, 0.8);
        const std::uint32_t n = 2 + random.below(4);
        const Vector end(std::sin(angle), -std::cos(angle), 0);
        add_body(s, box(0.1, 0.1, 0.1), end).mass = 1;
        DeformableSpec& string = add_soft(s, rope(Vector::Zero(), end, n));
        string.mass = 0.01, string.thickness = 0.01;
        string.elasticity.youngs_modulus = of_links ? 1e-6 : 1e10;
        string.elasticity.bending_stiffness = 0;
        hold(s, 0, {0});
        hold(s, 0, {n}, 0);
        if (of_links)
            for (std::uint32_t i = 0; i < n; ++i) add_link(s, point_of(0, i), point_of(0, i + 1));
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        PeriodWatch watch;
        double first = 0, last = 0;
        while (simulation.time() < 10) {
            ASSERT_TRUE(simulation.step().finite);
            const Vector at = world.bodies.position[0];
            const double swing = std::abs(std::atan2(at.x(), -at.y()));
            if (simulation.time() < 2.5) first = std::max(first, swing);
            if (simulation.time() > 7.5) last = std::max(last, swing);
            watch.see(simulation.time(), s.settings.dt, world.bodies.position[0].x());
        }
        // of the string's mass a third swings, and half is heavy
        const double string_share = std::sqrt((1 + 0.01 / 3) / (1 + 0.01 / 2));
        const double exact =
            2 * std::numbers::pi * std::sqrt(1 / 9.81) * lengthening(angle) * string_share;
        const double left = (1 - std::cos(last)) / (1 - std::cos(first));
        std::cout << (of_links ? "links " : "rope ") << n << ", " << angle << " rad, "
                  << s.settings.dt << " s x " << s.settings.substeps << " x "
                  << s.settings.position_iterations << ": period " << watch.period() / exact - 1
                  << ", energy " << left << "\n";
        EXPECT_NEAR(watch.period() / exact, 1, 0.005);
        EXPECT_GT(left, of_links ? 0.99 : 0.9) << "a rope is pulled along its line at the end";
        EXPECT_LT(left, 1.01);
    }
}

}  // namespace
}  // namespace plumb::test
