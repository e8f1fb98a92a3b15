// SPDX-License-Identifier: MIT
#include "islands/island_effort.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(IslandEffort, IsFullUntilAnIslandIsDisputed) {
    EXPECT_EQ(effort_of(0), IslandEffort::full);
    EXPECT_EQ(disputed_after(0, true), 0);
    EXPECT_EQ(effort_of(disputed_after(0, false)), IslandEffort::swept);
}

TEST(IslandEffort, OfADisputeIsSweepsThenLittleWork) {
    std::uint8_t disputed = kDisputed;
    for (int i = 0; i < kSweptSteps; ++i) {
        EXPECT_EQ(effort_of(disputed), IslandEffort::swept) << "step " << i;
        disputed = disputed_after(disputed, true);
    }
    for (int i = 0; i < kLightSteps; ++i) {
        EXPECT_EQ(effort_of(disputed), IslandEffort::light) << "step " << i;
        disputed = disputed_after(disputed, false);
    }
    EXPECT_EQ(effort_of(disputed), IslandEffort::full) << "tried again";
}

TEST(IslandEffort, StaysLittleWhileThatSolvesTheIsland) {
    std::uint8_t disputed = kLightSteps;
    for (int i = 0; i < 1000; ++i) disputed = disputed_after(disputed, true);
    EXPECT_EQ(disputed, kLightSteps);
}

}  // namespace
}  // namespace plumb
