// SPDX-License-Identifier: MIT
/// The systems of few and of many bodies against a dense one of the same matrix.
#include "islands/island_system.h"
#include "islands/island_account.h"
#include "support/block_system.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

using test::Random;
using Pattern = IslandSystem::Pattern;

void expect_solves(std::uint32_t rows, const Pattern& pattern, bool many, std::uint32_t seed) {
    Random random(seed);
    IslandSystem system;
    IslandSystem::Spare spare;
    ASSERT_TRUE(system.analyse(rows, pattern, many, kAnyProducts, spare));
    ASSERT_EQ(system.rows(), rows);
    test::expect_solves(pattern, random, system);
}

TEST(IslandSystem, SolvesFewAndManyAlike) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        const std::uint32_t rows = 1 + random.below(40);
        const Pattern pattern = test::drawn_pattern(rows, random);
        for (const bool many : {false, true}) expect_solves(rows, pattern, many, seed + 100);
    }
}

/// What is refused leaves nothing, whatever was there before.
TEST(IslandSystem, RefusesWhatTakesTooMuch) {
    Random random(7);
    const Pattern pattern = test::drawn_pattern(30, random);
    for (const bool before : {false, true})
        for (const bool many : {false, true}) {
            IslandSystem system;
            IslandSystem::Spare spare;
            ASSERT_TRUE(system.analyse(30, pattern, before, kAnyProducts, spare));
            ASSERT_TRUE(system.analyse(30, pattern, many, kAnyProducts, spare));
            const std::uint64_t needed = system.block_products();
            EXPECT_GT(needed, 30u + pattern.size() / 2);
            ASSERT_TRUE(system.analyse(30, pattern, before, kAnyProducts, spare));
            EXPECT_TRUE(system.analyse(30, pattern, many, needed, spare));
            ASSERT_TRUE(system.analyse(30, pattern, before, kAnyProducts, spare));
            EXPECT_FALSE(system.analyse(30, pattern, many, needed / 3, spare));
            EXPECT_EQ(system.rows(), 0u);
        }
}

}  // namespace
}  // namespace plumb
