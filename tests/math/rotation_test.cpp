// SPDX-License-Identifier: MIT
#include "math/rotation.h"
#include "math/rotation_between.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <numbers>

namespace plumb {
namespace {

using test::Random;
constexpr double kPi = std::numbers::pi;

TEST(RotationBetween, TurnsOneIntoTheOtherByTheLeastAngle) {
    Random random(7);
    for (int i = 0; i < 500; ++i) {
        const Vector3d from = random.vector(3), to = random.vector(0.2);
        const Eigen::Quaterniond turn = rotation_between(from, to);
        EXPECT_NEAR(turn.norm(), 1, 1e-15);
        EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-14);
        const double angle = std::acos(from.normalized().dot(to.normalized()));
        EXPECT_NEAR(Eigen::AngleAxisd(turn).angle(), angle, 1e-7);
    }
}

TEST(RotationBetween, TurnsHalfAroundWhereTheyAreOpposite) {
    Random random(8);
    for (const double off : {0.0, 1e-17, 1e-12, 1e-9, 1e-7, 1e-4}) {
        const Vector3d from = random.direction();
        const Vector3d to = (off * random.direction() - from).normalized();
        const Eigen::Quaterniond turn = rotation_between(from, to);
        EXPECT_NEAR(turn.norm(), 1, 1e-15);
        EXPECT_LT((turn * from - to).norm(), 3e-8) << off;
    }
    EXPECT_LT(rotation_between({0, 0, 2}, {0, 0, 5}).vec().norm(), 1e-16);
}

TEST(ExponentialMap, IsTheTurnAboutTheAxis) {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const Vector3d axis = random.direction();
        const double angle = random.number(-20, 20);
        const Eigen::AngleAxisd law(angle, axis);
        const Matrix3d r = exponential_map(angle * axis).toRotationMatrix();
        EXPECT_LT((r - law.toRotationMatrix()).norm(), 1e-13);
    }
}

TEST(ExponentialMap, IsUndoneByTheRotationVectorAtEverySize) {
    Random random(2);
    for (double size : {1e-300, 1e-15, 1e-9, 1e-5, 0.9e-4, 1.1e-4, 1e-3, 0.1, 1.0, 3.0, 3.14}) {
        const Vector3d theta = size * random.direction();
        EXPECT_LT((rotation_vector(exponential_map(theta)) - theta).norm(), 1e-14 + 1e-12 * size)
            << size;
    }
    EXPECT_EQ(rotation_vector(exponential_map(Vector3d::Zero())), Vector3d::Zero());
}

TEST(RotationVector, TakesTheShorterWayRound) {
    const Vector3d axis = Vector3d(1, 2, -2) / 3;
    EXPECT_LT((rotation_vector(exponential_map(1.5 * kPi * axis)) + 0.5 * kPi * axis).norm(),
              1e-12);
    const Quaterniond q = exponential_map(0.3 * axis);
    const Quaterniond opposite(-q.coeffs());
    EXPECT_LT((rotation_vector(opposite) - 0.3 * axis).norm(), 1e-14);
}

TEST(Turned, StaysAUnitQuaternionOverManySmallTurns) {
    Quaterniond q = Quaterniond::Identity();
    const Vector3d theta(0.01, -0.02, 0.005);
    for (int i = 0; i < 10000; ++i) q = turned(q, theta);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    const Matrix3d law = exponential_map(10000 * theta).toRotationMatrix();
    EXPECT_LT((q.toRotationMatrix() - law).norm(), 1e-10);
}

/// Over |ϑ| from `least` to `greatest` [rad].
template <class T>
double worst_error_of_turns(double least, double greatest) {
    Random random(3);
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vector3<T> theta = (random.number(least, greatest) * random.direction()).cast<T>();
        const Vector3<T> r = random.vector(3).cast<T>();
        const Vector3d exact_r = r.template cast<double>();
        const Vector3d law = exponential_map(theta.template cast<double>()) * exact_r - exact_r;
        const Vector3<T> turn = Turn<T>(theta).change(r);
        worst = std::max(worst, (turn.template cast<double>() - law).norm() / exact_r.norm());
    }
    return worst;
}
TEST(TurnOf, IsTheExactTurnInDouble) {
    EXPECT_LT(worst_error_of_turns<double>(0, 1.5), 1e-13);
    EXPECT_LT(worst_error_of_turns<double>(1.5, 50), 1e-13);
}
TEST(TurnOf, IsTheExactTurnToAFewRoundingsInSingle) {
    EXPECT_LT(worst_error_of_turns<float>(0, 1.5), 3e-7);
    EXPECT_LT(worst_error_of_turns<float>(1.5, 50), 1e-5) << "of 50 rad, those of the angle";
}

/// Small turns keep their digits: an error is a share of the turn, not of the arm.
TEST(TurnOf, KeepsTheDigitsOfSmallTurns) {
    const Vector3<float> theta(1e-5f, 0, 0), r(0, 1, 0);
    EXPECT_FLOAT_EQ(Turn<float>(theta).change(r)[2], 1e-5f);
    EXPECT_NEAR(Turn<float>(theta).change(r)[1], -0.5e-10, 1e-16);
}

}  // namespace
}  // namespace plumb
