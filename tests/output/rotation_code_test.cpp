// SPDX-License-Identifier: MIT
#include "output/rotation_code.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace plumb {
namespace {

class RotationBits : public testing::TestWithParam<int> {};

TEST_P(RotationBits, ComesBackWithinTheBoundAndTheBoundIsNotIdle) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const Eigen::Quaterniond q =
            Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                .normalized();
        const Eigen::Quaterniond back = decode_rotation(encode_rotation(q, GetParam()), GetParam());
        worst = std::max(worst, q.angularDistance(back));
    }
    EXPECT_LE(worst, rotation_error_bound(GetParam()));
    EXPECT_GE(worst, rotation_error_bound(GetParam()) / 4);
}

INSTANTIATE_TEST_SUITE_P(Formats, RotationBits, testing::Values(10, 14, 20));

TEST(RotationCode, EqualComponentsAndHalfTurnsComeBack) {
    for (const Eigen::Vector4d& c : {Eigen::Vector4d(1, 1, 1, 1), Eigen::Vector4d(-1, 1, -1, 1),
                                     Eigen::Vector4d(1, 0, 0, 0), Eigen::Vector4d(0, 0, -1, 0),
                                     Eigen::Vector4d(0, 0, 0, -1), Eigen::Vector4d(1, -1, 0, 0)}) {
        const Eigen::Quaterniond q = Eigen::Quaterniond(c).normalized();
        const Eigen::Quaterniond back = decode_rotation(encode_rotation(q, 14), 14);
        EXPECT_LE(q.angularDistance(back), rotation_error_bound(14));
    }
}

TEST(RotationCode, WhatIsNoRotationBecomesTheIdentity) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Eigen::Quaterniond& q :
         {Eigen::Quaterniond(0, 0, 0, 0), Eigen::Quaterniond(1, nan, 0, 0)}) {
        const Eigen::Quaterniond back = decode_rotation(encode_rotation(q, 14), 14);
        EXPECT_LE(back.angularDistance(Eigen::Quaterniond::Identity()), rotation_error_bound(14));
    }
}

}  // namespace
}  // namespace plumb
