// SPDX-License-Identifier: MIT
#include "math/logarithm.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumb::test {
namespace {

TEST(NaturalLog, IsThatOfTheLibrary) {
    for (double x = 1e-3; x < 1e4; x *= 1.03) {
        const bool is_middle = x > 0.01 && x < 100;
        EXPECT_NEAR(natural_log(x), std::log(x), is_middle ? 1e-9 : 5e-6) << x;
        EXPECT_NEAR(natural_log(static_cast<float>(x)), std::log(x), 6e-6) << x;
    }
}

TEST(NaturalLog, HasAllDigitsNearOne) {
    EXPECT_EQ(natural_log(1.0), 0);
    for (const double e : {1e-3, -1e-6, 1e-9, 1e-15}) {
        const double x = 1 + e, law = std::log1p(x - 1);
        EXPECT_NEAR(natural_log(x) / law, 1, 1e-14) << e;
    }
    for (const float e : {1e-3f, -1e-4f, 1e-6f}) {
        const float x = 1 + e;
        EXPECT_NEAR(natural_log(x) / std::log1p(x - 1), 1, 1e-6) << e;
    }
}

TEST(NaturalLog, IsTheSameInEachLane) {
    alignas(16) float x[4] = {0.3f, 1.0f, 7.3f, 500.0f}, seen[4];
    natural_log(Lanes<float, 4>::load(x)).store(seen);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(seen[i], natural_log(x[i]));
}

}  // namespace
}  // namespace plumb::test
