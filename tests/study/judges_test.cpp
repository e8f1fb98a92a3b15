// SPDX-License-Identifier: MIT
/// Judges of what swings, on swings whose answers are known.
#include "study/judges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace plumb::study {
namespace {

/// offset + cos, starting anywhere in a swing, of 0.7 Hz and at 100 moments a second.
Swings swings(double offset, double phase, double duration) {
    Swings s;
    for (double t = 0; t < duration; t += 0.01)
        s.add(t, offset + std::cos(2 * std::numbers::pi * 0.7 * t + phase));
    return s;
}

TEST(Swings, HaveTheirFrequencyAndMean) {
    for (const double offset : {0.0, 0.05, -0.2})
        for (const double phase : {0.0, 1.0, 3.0, 5.0}) {
            const Swings s = swings(offset, phase, 10.3);
            EXPECT_NEAR(s.frequency(), 0.7, 1e-4) << offset << ", " << phase;
            EXPECT_NEAR(s.mean(), offset, 1e-3) << offset << ", " << phase;
        }
}

TEST(Swings, ThatAreNoneHaveTheMeanOfAllTime) {
    const Swings s = swings(5, 0, 10 / 0.7);
    EXPECT_EQ(s.frequency(), 0);
    EXPECT_NEAR(s.mean(), 5, 5e-3);
    EXPECT_EQ(Swings().mean(), 0);
}

}  // namespace
}  // namespace plumb::study
