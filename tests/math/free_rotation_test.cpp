// SPDX-License-Identifier: MIT
#include "math/free_rotation.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb {
namespace {

using test::Random;

/// Moments that a real body can have: none is more than the other two together.
Vector3d moments(Random& random) {
    const Vector3d masses(random.number(0.01, 2), random.number(0.01, 2), random.number(0.01, 2));
    return {masses.y() + masses.z(), masses.x() + masses.z(), masses.x() + masses.y()};
}

TEST(MiddleRate, SolvesItsEquationForTurnsOfUpToHalfARadian) {
    Random random(7);
    for (int i = 0; i < 500; ++i) {
        const Vector3d inertia = moments(random), inverse = inertia.cwiseInverse();
        const double h = 0.01, turn = std::pow(10.0, random.number(-4, -0.31));
        const Vector3d momentum = inertia.cwiseProduct(turn / h * random.direction());
        const Vector3d w = middle_rate<double>(momentum, inertia, inverse, h);
        const Vector3d seen = exponential_map(-0.5 * h * w) * momentum;
        EXPECT_LT((inertia.cwiseProduct(w) - seen).norm(), 1e-9 * momentum.norm()) << turn;
    }
}

/// Euler's equations in the body's frame with the momentum kept in space, by many small steps of
/// fourth order.
Vector3d reference_momentum(Vector3d l, const Vector3d& inverse, double time) {
    const auto rate = [&](const Vector3d& x) { return Vector3d(x.cross(inverse.cwiseProduct(x))); };
    constexpr int kSteps = 2000;
    const double h = time / kSteps;
    for (int i = 0; i < kSteps; ++i) {
        const Vector3d a = rate(l), b = rate(l + h / 2 * a), c = rate(l + h / 2 * b),
                       d = rate(l + h * c);
        l += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return l;
}

TEST(MiddleRate, TurnsAFreeBodyAtSecondOrder) {
    const Vector3d inertia(1, 2, 2.5), inverse = inertia.cwiseInverse(), start(0.7, -1.1, 0.4);
    const auto error_with = [&](int steps) {
        Vector3d l = start;
        const double h = 1.0 / steps;
        for (int i = 0; i < steps; ++i)
            l = exponential_map(-h * middle_rate<double>(l, inertia, inverse, h)) * l;
        return (l - reference_momentum(start, inverse, 1)).norm();
    };
    const double coarse = error_with(20), fine = error_with(40);
    EXPECT_LT(fine, 1e-4);
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

TEST(MiddleRate, KeepsARateThatTurnsTooFar) {
    Random random(10);
    for (int i = 0; i < 200; ++i) {
        const Vector3d inertia = moments(random), inverse = inertia.cwiseInverse();
        const Vector3d rate = random.number(110, 1e4) * random.direction();
        const Vector3d before = inertia.cwiseProduct(rate);
        EXPECT_LT((middle_rate<double>(before, inertia, inverse, 0.01) - rate).norm(),
                  1e-12 * rate.norm());
        EXPECT_EQ(turns_too_far<double>(rate, 0.01), 1);
        EXPECT_EQ(turns_too_far<double>(Vector3d(rate * (49 / rate.norm())), 0.01), 0);
    }
}

TEST(FreeTurn, FollowsEulersEquations) {
    Random random(12);
    for (int i = 0; i < 100; ++i) {
        const Vector3d inertia = moments(random), inverse = inertia.cwiseInverse();
        const Vector3d start = inertia.cwiseProduct(random.number(0.1, 5) * random.direction());
        Vector3d l = start;
        const UnitQuaternion<double> turn = free_turn<double>(l, inverse, 1.0);
        EXPECT_LT((l - reference_momentum(start, inverse, 1)).norm(), 1e-4 * start.norm());
        EXPECT_LT((turn * l - start).norm(), 1e-13 * start.norm());
    }
}

TEST(FreeTurn, KeepsEnergyAtAnyRate) {
    Random random(13);
    for (int i = 0; i < 500; ++i) {
        const Vector3d inertia = moments(random), inverse = inertia.cwiseInverse();
        const double rate = std::pow(10.0, random.number(-6, 5));
        Vector3d axis = random.direction();
        if (i % 3 == 0) axis = Vector3d::Unit(i % 9 / 3);
        const Vector3d start = inertia.cwiseProduct(rate * axis);
        Vector3d l = start;
        free_turn<double>(l, inverse, 0.01);
        const double work = start.dot(inverse.cwiseProduct(start));
        EXPECT_NEAR(l.dot(inverse.cwiseProduct(l)), work, 1e-11 * work) << rate;
        EXPECT_NEAR(l.norm(), start.norm(), 1e-12 * start.norm()) << rate;
    }
}

TEST(FreeTurn, IsOfFourthOrder) {
    const Vector3d inertia(1, 2, 2.5), inverse = inertia.cwiseInverse(), start(0.7, -1.1, 0.4);
    const auto error_with = [&](double parts) {
        Vector3d l = start;
        turn_in_parts<double>(l, EnergyParts<double>(inverse), 1.0, parts);
        return (l - reference_momentum(start, inverse, 1)).norm();
    };
    EXPECT_LT(error_with(1), 1e-4);
    EXPECT_NEAR(std::log2(error_with(1) / error_with(2)), 4, 0.5);
}

TEST(FreeTurn, TurnsInPartsAsItsRateAsksFor) {
    const auto parts = [&](const Vector3d& inertia, const Vector3d& rate) {
        const Vector3d inverse = inertia.cwiseInverse(), l = inertia.cwiseProduct(rate);
        return part_count<double>(l, EnergyParts<double>(inverse), l.dot(rate), 0.01);
    };
    EXPECT_EQ(parts({1, 2, 2.5}, {0, 0, 0}), 1);
    EXPECT_EQ(parts({1, 2, 2.5}, {20, 10, 0}), 1);
    EXPECT_GT(parts({1, 2, 2.5}, {500, 300, 0}), 5);
    EXPECT_EQ(parts({1, 2, 2.5}, {1e9, 1e8, 0}), 400);
    EXPECT_EQ(parts({2, 2, 3}, {500, 300, 100}), 1) << "known in closed form";
}

TEST(FreeTurn, GivesEachLaneTheBitsOfANumberAlone) {
    using T = Lanes<double, 4>;
    Random random(14);
    for (int i = 0; i < 100; ++i) {
        Vector3d l[4], inverse[4];
        Vector3<T> ls, inverses;
        for (int lane = 0; lane < 4; ++lane) {
            inverse[lane] = moments(random).cwiseInverse();
            l[lane] = std::pow(10.0, random.number(-6, 4)) * random.direction();
            for (int k = 0; k < 3; ++k) {
                set_number(ls[k], lane, l[lane][k]);
                set_number(inverses[k], lane, inverse[lane][k]);
            }
        }
        const UnitQuaternion<T> turns = free_turn<T>(ls, inverses, T(0.01));
        for (int lane = 0; lane < 4; ++lane) {
            const UnitQuaternion<double> alone = free_turn<double>(l[lane], inverse[lane], 0.01);
            EXPECT_EQ(number_of(turns.w, lane), alone.w);
            for (int k = 0; k < 3; ++k) {
                EXPECT_EQ(number_of(turns.v[k], lane), alone.v[k]);
                EXPECT_EQ(number_of(ls[k], lane), l[lane][k]);
            }
        }
    }
}

TEST(MiddleRate, GivesEachLaneTheBitsOfANumberAlone) {
    using T = Lanes<double, 4>;
    Random random(9);
    for (int i = 0; i < 200; ++i) {
        Vector3d inertia[4], momentum[4];
        Vector3<T> inertias, inverses, momenta;
        for (int lane = 0; lane < 4; ++lane) {
            inertia[lane] = moments(random);
            momentum[lane] = std::pow(10.0, random.number(-6, 4)) * random.direction();
            for (int k = 0; k < 3; ++k) {
                set_number(inertias[k], lane, inertia[lane][k]);
                set_number(inverses[k], lane, 1 / inertia[lane][k]);
                set_number(momenta[k], lane, momentum[lane][k]);
            }
        }
        const Vector3<T> rates = middle_rate<T>(momenta, inertias, inverses, T(0.01));
        for (int lane = 0; lane < 4; ++lane) {
            const Vector3d alone = middle_rate<double>(
                momentum[lane], inertia[lane],
                Vector3d(1 / inertia[lane][0], 1 / inertia[lane][1], 1 / inertia[lane][2]), 0.01);
            for (int k = 0; k < 3; ++k) EXPECT_EQ(number_of(rates[k], lane), alone[k]);
        }
    }
}

TEST(UnitQuaternion, IsEigensQuaternion) {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const Vector3d theta = random.number(0, 20) * random.direction(), x = random.vector(2);
        const UnitQuaternion<double> q = unit_exponential<double>(theta);
        const Quaterniond law(Eigen::AngleAxisd(theta.norm(), theta.normalized()));
        EXPECT_LT((q * x - law * x).norm(), 1e-14 * (1 + theta.norm()));
        EXPECT_LT((q.change(x) - (q * x - x)).norm(), 1e-15 * 10);
        EXPECT_LT((q.inverse() * (q * x) - x).norm(), 1e-14);
        Vector3d axes[3];
        q.columns(axes);
        for (int k = 0; k < 3; ++k)
            EXPECT_LT((axes[k] - law * Vector3d::Unit(k)).norm(), 1e-14 * (1 + theta.norm()));
        const Vector3d other = random.vector(1);
        const UnitQuaternion<double> both = unit_exponential<double>(other) * q;
        EXPECT_LT((both * x - unit_exponential<double>(other) * (q * x)).norm(), 1e-14);
    }
}

TEST(UnitQuaternion, LosesNothingOfSmallTurns) {
    const Vector3d theta(3e-9, -1e-9, 2e-9), x(1, 2, -1);
    const Vector3d change = unit_exponential<double>(theta).change(x);
    EXPECT_LT((change - theta.cross(x)).norm(), 1e-16 * 10);
    EXPECT_LT((change - theta.cross(x) - 0.5 * theta.cross(theta.cross(x))).norm(), 1e-23);
}

}  // namespace
}  // namespace plumb
