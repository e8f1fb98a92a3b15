// SPDX-License-Identifier: MIT
#include "math/root.h"

#include <gtest/gtest.h>
#include <cmath>

namespace plumb {
namespace {

TEST(RootOfShare, InvertsThePower) {
    for (const double a : {1.0, 0.8, 0.32768, 0.5, 1e-3})
        for (const std::uint32_t n : {1u, 2u, 3u, 5u, 20u, 100u}) {
            const double x = root_of_share(a, n);
            EXPECT_NEAR(x, std::pow(a, 1.0 / n), 4e-15) << a << " " << n;
        }
}

TEST(RootOfShare, OfNothingIsNothing) {
    EXPECT_EQ(root_of_share(0, 1), 0);
    EXPECT_EQ(root_of_share(0, 7), 0);
}

}  // namespace
}  // namespace plumb
