// SPDX-License-Identifier: MIT
/// The formulas that the cases are measured against, held against others.
#include "study/elliptic.h"
#include "study/free_top.h"
#include "study/two_rods.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plumb::study {
namespace {

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
