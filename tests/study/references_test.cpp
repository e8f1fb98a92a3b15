// SPDX-License-Identifier: MIT
/// The formulas that the cases are measured against, held against others.
#include "study/catenary.h"
#include "study/elastic_laws.h"
#include "study/elliptic.h"
#include "study/free_top.h"
#include "study/two_rods.h"

#include <gtest/gtest.h>
#include <Eigen/Core>

#include <numbers>

namespace plumb::study {
namespace {

/// The lowest rate at which Timoshenko's equations of a beam that is held at one end have a
/// solution, by shooting: unknown moment and shear at the wall, none at the tip.
double timoshenko_frequency(const Cantilever& b) {
    const double area = b.height * b.width, inertia = area * b.height * b.height / 12,
                 bending = b.young * inertia, kappa = 10 * (1 + b.nu) / (12 + 11 * b.nu),
                 shear = kappa * area * b.young / (2 * (1 + b.nu));
    /// Determinant of moment and shear at the tip of both solutions.
    const auto left = [&](double rate) {
        const double w2 = b.density * rate * rate;
        double tip[2][2];
        for (int k = 0; k < 2; ++k) {
            // deflection, turn, moment, shear
            Eigen::Vector4d y(0, 0, k == 0, k == 1);
            Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
            m(0, 1) = 1, m(0, 3) = 1 / shear, m(1, 2) = 1 / bending;
            m(2, 1) = -w2 * inertia, m(2, 3) = -1, m(3, 0) = -w2 * area;
            const int steps = 2000;
            const double h = b.length / steps;
            for (int i = 0; i < steps; ++i) {
                const Eigen::Vector4d k1 = m * y, k2 = m * (y + h / 2 * k1),
                                      k3 = m * (y + h / 2 * k2), k4 = m * (y + h * k3);
                y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
            }
            tip[k][0] = y[2], tip[k][1] = y[3];
        }
        return tip[0][0] * tip[1][1] - tip[0][1] * tip[1][0];
    };
    double low = 0, high = 1;
    while (left(high) * left(0) > 0) low = high, high *= 1.1;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (left(middle) * left(0) > 0 ? low : high) = middle;
    }
    return low / (2 * std::numbers::pi);
}

/// Abramowitz, Stegun: 16.5 and the limits of 16.6.
TEST(Elliptic, HasItsKnownValues) {
    for (const double k : {0.0, 0.1, 0.5, 0.9, 0.99, 0.9999}) {
        const double quarter = std::comp_ellint_1(k), rest = std::sqrt((1 - k) * (1 + k));
        const Elliptic at = jacobi(quarter, k), half = jacobi(quarter / 2, k);
        EXPECT_NEAR(at.sn, 1, 1e-14) << k;
        EXPECT_NEAR(at.cn, 0, 1e-13) << k;
        EXPECT_NEAR(at.dn, rest, 1e-13) << k;
        EXPECT_NEAR(half.sn, 1 / std::sqrt(1 + rest), 1e-13) << k;
        EXPECT_NEAR(half.cn, std::sqrt(rest / (1 + rest)), 1e-13) << k;
        EXPECT_NEAR(half.dn, std::sqrt(rest), 1e-13) << k;
    }
    EXPECT_NEAR(jacobi(0.7, 0).sn, std::sin(0.7), 1e-15);
    EXPECT_NEAR(jacobi(0.7, 1 - 1e-12).sn, std::tanh(0.7), 1e-11);
}

/// sn′ = cn dn, cn′ = −sn dn, dn′ = −k² sn cn, everywhere in four periods.
TEST(Elliptic, ObeysItsEquations) {
    const double k = 0.8, d = 1e-5;
    for (double u = -8; u < 8; u += 0.37) {
        const Elliptic e = jacobi(u, k), after = jacobi(u + d, k), before = jacobi(u - d, k);
        EXPECT_NEAR((after.sn - before.sn) / (2 * d), e.cn * e.dn, 1e-9);
        EXPECT_NEAR((after.cn - before.cn) / (2 * d), -e.sn * e.dn, 1e-9);
        EXPECT_NEAR((after.dn - before.dn) / (2 * d), -k * k * e.sn * e.cn, 1e-9);
        EXPECT_NEAR(e.sn * e.sn + e.cn * e.cn, 1, 1e-14);
    }
}

/// Euler's equations: I ω′ = (I ω) × ω.
TEST(FreeTop, ObeysEulersEquations) {
    const Vector3d inertia(0.05, 0.10, 0.13);
    for (const Vector3d& start : {Vector3d(1, 2, 3), Vector3d(0, 6, 0.06)}) {
        const FreeTop top(inertia, start);
        EXPECT_LT((top.angular_velocity(0) - start).norm(), 1e-13 * start.norm());
        for (double t = 0; t < 6; t += 0.1) {
            const double d = 1e-5;
            const Vector3d w = top.angular_velocity(t);
            const Vector3d change =
                (top.angular_velocity(t + d) - top.angular_velocity(t - d)) / (2 * d);
            const Vector3d law = inertia.cwiseProduct(w).cross(w).cwiseQuotient(inertia);
            EXPECT_LT((change - law).norm(), 1e-7) << t;
            EXPECT_NEAR(top.ahead(w, t), 0, 1e-12) << t;
            EXPECT_NEAR(top.ahead(top.angular_velocity(t + 0.01), t), 0.01, 1e-12) << t;
        }
    }
}

TEST(FreeTop, FlipsInItsInterval) {
    const FreeTop top({0.05, 0.10, 0.13}, {0, 6, 0.06});
    const double interval = top.flip_interval();
    EXPECT_NEAR(top.angular_velocity(interval / 2).y(), 0, 1e-10);
    EXPECT_NEAR(top.angular_velocity(3 * interval / 2).y(), 0, 1e-10);
    EXPECT_NEAR(top.angular_velocity(interval).y(), -6, 1e-10);
}

/// y = a cosh(x/a), 2 a sinh(1/2a) = 2: of a chain of length 2 and span 1.
TEST(Catenary, OfManyLinksIsThatOfAChain) {
    double a = 0.2;
    for (int i = 0; i < 50; ++i)  // Newton
        a -= (2 * a * std::sinh(0.5 / a) - 2) / (2 * std::sinh(0.5 / a) - std::cosh(0.5 / a) / a);
    const Catenary chain(1000, 0.002, 1);
    EXPECT_NEAR(-chain.begin(500).y(), a * (std::cosh(0.5 / a) - 1), 1e-6);
    EXPECT_NEAR(chain.pull() / 1000, 0.5 * std::hypot(1, a), 1e-6);
    EXPECT_LT((chain.begin(1000) - Vector3d(1, 0, 0)).norm(), 1e-9);
}

/// Each link is as much longer as the force in it says, and forces differ by a link's weight.
TEST(Catenary, StretchesByHooke) {
    const Catenary rope(40, 0.05, 1, 1e-3);
    for (int i = 0; i < 40; ++i) {
        const double force = (rope.length(i) / 0.05 - 1) / 1e-3;  // over a link's weight
        const Vector3d pull = force * rope.along(i);
        EXPECT_NEAR(pull.y(), i - 19.5, 1e-9) << i;
        EXPECT_NEAR(pull.x(), (rope.length(0) / 0.05 - 1) / 1e-3 * rope.along(0).x(), 1e-9) << i;
    }
    EXPECT_LT((rope.begin(40) - Vector3d(1, 0, 0)).norm(), 1e-9);
}

/// Work is force times way: ∂/∂λ of E A (λ² − 1)²/8.
TEST(ElasticLaws, TellTheStretchOfASheet) {
    for (const double force : {1e-4, 0.01, 0.3}) {
        const double d = 1e-5, stretch = green_stretch(force);
        const auto energy = [](double s) { return (s * s - 1) * (s * s - 1) / 8; };
        EXPECT_NEAR((energy(stretch + d) - energy(stretch - d)) / (2 * d), force, 1e-9);
    }
    EXPECT_NEAR(hanging_elongation(20, 1e-6) / 1e-6, 1, 1e-5);
    EXPECT_NEAR(hanging_elongation(1000, 0.01), hanging_elongation(20, 0.01), 1e-5);
}

/// The work of the pressure, p 4π r², is that of the skin: energy 4π R² E t (λ² − 1)²/4(1 − ν).
TEST(ElasticLaws, TellThePressureInASkin) {
    const double radius = 0.5, stiffness = 100, nu = 0.3, stretch = 1.15, d = 1e-5;
    const auto energy = [&](double s) {
        const double strain = (s * s - 1) / 2;
        return 4 * std::numbers::pi * radius * radius * stiffness * strain * strain / (1 - nu);
    };
    const double force = (energy(stretch + d) - energy(stretch - d)) / (2 * d * radius);
    const double area = 4 * std::numbers::pi * radius * radius * stretch * stretch;
    EXPECT_NEAR(pressure_in_skin(stretch, radius, stiffness, nu) * area, force, 1e-5);
}

/// A slender beam is Euler and Bernoulli's, a thick one Timoshenko's.
TEST(ElasticLaws, TellHowABeamHangsAndSwings) {
    Cantilever beam{
        .length = 3, .height = 0.01, .width = 0.02, .young = 1e9, .nu = 0.3, .density = 500};
    const double inertia = beam.width * std::pow(beam.height, 3) / 12, area = 2e-4;
    const double load = beam.density * 9.81 * area;
    EXPECT_NEAR(beam.deflection(9.81) / (load * 81 / (8 * beam.young * inertia)), 1, 1e-4);
    EXPECT_NEAR(beam.frequency() / (1.8751041 * 1.8751041 / (2 * std::numbers::pi) *
                                    std::sqrt(beam.young * inertia / (load / 9.81 * 81))),
                1, 1e-4);
    beam.height = 0.6;
    EXPECT_NEAR(beam.frequency() / timoshenko_frequency(beam), 1, 3e-3);
}

const RodAngles kRaised{{std::numbers::pi / 2, std::numbers::pi / 2}, {}};

TEST(TwoRods, KeepTheirEnergy) {
    const TwoRods rods;
    const double start = rods.energy(kRaised);
    for (const double time : {0.5, 1.0, 2.0})
        EXPECT_NEAR(rods.energy(rods.advance(kRaised, time)), start, 1e-11) << time;
}

/// Runge and Kutta's error is of fourth order, and far below the errors that are measured by it.
TEST(TwoRods, ComeToTheSameAtOtherSteps) {
    const TwoRods rods;
    const auto angle = [&](double step) { return rods.advance(kRaised, 2, step).angle[1]; };
    const double exact = angle(1e-5);
    EXPECT_NEAR(angle(1e-4), exact, 1e-10);
    EXPECT_NEAR(std::log2((angle(8e-3) - exact) / (angle(4e-3) - exact)), 4, 0.3);
}

/// Small swings: (K − s g M) θ = 0 with M = [[4/3, 1/2], [1/2, 1/3]] and K = diag(3/2, 1/2) has two
/// modes, whose rates are √(s g).
TEST(TwoRods, HaveTheRatesOfSmallSwings) {
    const TwoRods rods;
    const double a = 4.0 / 9 - 1.0 / 4, b = -(1.5 / 3 + 0.5 * 4 / 3), c = 1.5 * 0.5;
    for (const double sign : {-1.0, 1.0}) {
        const double s = (-b + sign * std::sqrt(b * b - 4 * a * c)) / (2 * a);
        const double ratio = (1.5 - s * 4 / 3) / (0.5 * s);  // of the mode's angles
        const RodAngles start{{1e-5, 1e-5 * ratio}, {}};
        const RodAngles half = rods.advance(start, std::numbers::pi / std::sqrt(s * rods.gravity));
        EXPECT_NEAR(half.angle[0] / start.angle[0], -1, 1e-7);
        EXPECT_NEAR(half.angle[1] / start.angle[1], -1, 1e-7);
    }
}

}  // namespace
}  // namespace plumb::study
