// SPDX-License-Identifier: MIT
/// The set-valued force law of what acts along one axis against a search by halves for the point
/// where it is met.
#include "constraints/axis_drive.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

using test::Random;
constexpr double kAny = std::numeric_limits<double>::infinity();

/// Rows as drive_rows.h makes them: bounded steps, slopes with and without ends, hard limits.
AxisDrive random_axis(Random& random) {
    AxisDrive axis;
    const int rows = static_cast<int>(random.number(1, 5.99));
    for (int i = 0; i < rows; ++i) {
        DriveRow row{random.number(-2, 2), 0, 0, 0};
        const double kind = random.number(0, 5);
        const double bound = random.number(0, 3);
        if (kind < 1) row.lowest = -bound, row.highest = bound;
        if (kind >= 1 && kind < 2)
            row.softness = random.number(0.1, 4), row.lowest = -kAny, row.highest = kAny;
        if (kind >= 2 && kind < 3)
            row.softness = random.number(0.1, 4), row.lowest = -bound, row.highest = bound;
        if (kind >= 3 && kind < 4) row.highest = kAny;
        if (kind >= 4) row.lowest = -kAny;
        axis.add(row);
    }
    return axis;
}

/// Where the line meets the force law, which falls while the line climbs.
double met_by_halves(const AxisDrive& axis, double rate, double impulse, double response) {
    double low = -1e6, high = 1e6;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        const double beyond =
            middle - rate - response * (impulse_beside(axis, middle, 1) - impulse);
        (beyond >= 0 ? high : low) = middle;
    }
    return high;
}

TEST(AxisDrive, IsMetWhereASearchByHalvesMeetsIt) {
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        const AxisDrive axis = random_axis(random);
        const double rate = random.number(-4, 4), impulse = random.number(-3, 3),
                     response = std::exp(random.number(-3, 3));
        const AxisAnswer answer = answer_of(axis, rate, impulse, response);
        ASSERT_NEAR(answer.rate, met_by_halves(axis, rate, impulse, response), 1e-9) << i;
        ASSERT_NEAR(answer.rate, rate + response * (answer.impulse - impulse), 1e-9) << i;
        const double below = impulse_beside(axis, answer.rate - 1e-9, 1),
                     above = impulse_beside(axis, answer.rate + 1e-9, 1);
        ASSERT_LE(answer.impulse, below + 1e-6) << i;
        ASSERT_GE(answer.impulse, above - 1e-6) << i;
        if (!answer.is_step) {
            const double expected = impulse_beside(axis, answer.rate + 1e-7, 1);
            const double next_corner = std::abs(answer.impulse - answer.slope * 1e-7 - expected);
            ASSERT_LT(next_corner, 1e-5) << i;
        }
    }
}

TEST(AxisDrive, SharesItsImpulseAmongItsRows) {
    Random random(2);
    for (int i = 0; i < 20000; ++i) {
        const AxisDrive axis = random_axis(random);
        const AxisAnswer answer =
            answer_of(axis, random.number(-4, 4), random.number(-3, 3), random.number(0.1, 3));
        double shares[AxisDrive::kMostRows] = {}, sum = 0;
        share_impulse(axis, answer, shares);
        for (int k = 0; k < axis.n; ++k) {
            ASSERT_GE(shares[k], axis.rows[k].lowest) << i;
            ASSERT_LE(shares[k], axis.rows[k].highest) << i;
            sum += shares[k];
        }
        ASSERT_NEAR(sum, answer.impulse, 1e-9 * std::max(1.0, std::abs(sum))) << i;
    }
}

TEST(AxisDrive, ALimitOutbidsAGreatestSpeed) {
    AxisDrive axis;
    axis.add(speed_row(-0.1, 1));                 // no faster than 1 to the lower side
    axis.add(limit_row(5, 0, -1, 1, 1, 100, 0.01));  // far beyond the upper limit: back at 100
    const AxisAnswer answer = answer_of(axis, 0, 0, 1);
    EXPECT_TRUE(answer.is_step);
    EXPECT_DOUBLE_EQ(answer.rate, -100);
}

TEST(AxisDrive, StandsStillUpToItsFrictionAndNoFurther) {
    AxisDrive axis;
    axis.add(friction_row(2, {1}));
    EXPECT_TRUE(answer_of(axis, 1.9, 0, 1).is_step);
    const AxisAnswer slips = answer_of(axis, 2.5, 0, 1);
    EXPECT_FALSE(slips.is_row());
    EXPECT_DOUBLE_EQ(slips.impulse, -2);
    EXPECT_DOUBLE_EQ(slips.rate, 0.5);
}

}  // namespace
}  // namespace plumb
