// SPDX-License-Identifier: MIT
#include "constraints/rolling.h"
#include "support/random.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

using test::Random;
using test::symmetric;

TEST(Rolling, OneTorqueStopsTheTurningAboutAnAxis) {
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        const Vector3d none = Vector3d::Zero(), axis = random.direction();
        const InverseMass<double> a{1, symmetric(random.tensor())},
            b{1, symmetric(random.tensor())};
        Velocity<double> x{none, random.vector()}, y{none, random.vector()};
        const double effective = 1 / angular_response<double>(a, b, axis, axis);
        double torque = 0;
        const double change = resist_spin(torque, axis.dot(x.w - y.w), effective, 1e9);
        apply_torque<double>(x, a, change * axis);
        apply_torque<double>(y, b, -change * axis);
        EXPECT_NEAR(axis.dot(x.w - y.w), 0, 1e-12);
        EXPECT_EQ(torque, change);
    }
}

TEST(Rolling, TorqueStaysWithinItsBoundAndOpposesTheTurning) {
    double torque = 0;
    EXPECT_EQ(resist_spin(torque, 3.0, 10.0, 2.0), -2);
    EXPECT_EQ(torque, -2);
    EXPECT_EQ(resist_spin(torque, 3.0, 10.0, 2.0), 0);
    EXPECT_EQ(resist_spin(torque, -0.1, 10.0, 2.0), 1);
    EXPECT_EQ(torque, -1);
    EXPECT_EQ(resist_spin(torque, -5.0, 10.0, 0.5), 1.5);
    EXPECT_EQ(torque, 0.5);
}

}  // namespace
}  // namespace plumb
