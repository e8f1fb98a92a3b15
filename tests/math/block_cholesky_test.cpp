// SPDX-License-Identifier: MIT
/// The sparse factorisation against a dense one of the same matrix.
#include "math/block_cholesky.h"
#include "support/block_system.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

using test::Random;
using Pattern = BlockCholesky::Pattern;

void expect_solves(std::uint32_t rows, const Pattern& pattern, std::uint32_t seed) {
    Random random(seed);
    BlockCholesky system;
    system.analyse(rows, pattern);
    for (int again = 0; again < 2; ++again) test::expect_solves(pattern, random, system);
}

TEST(BlockCholesky, SolvesChainsAndRings) {
    for (std::uint32_t n : {1u, 2u, 7u, 30u}) {
        Pattern chain;
        for (std::uint32_t i = 1; i < n; ++i) chain.emplace_back(i, i - 1);
        expect_solves(n, chain, n);
        if (n > 2) chain.emplace_back(0, n - 1);
        expect_solves(n, chain, n + 100);
    }
}

TEST(BlockCholesky, SolvesRandomGraphsWithPairsThatComeTwice) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        const std::uint32_t n = 2 + random.below(40);
        expect_solves(n, test::drawn_pattern(n, random), seed + 1000);
    }
}

TEST(BlockCholesky, AnalysesOnePatternAfterAnother) {
    Random random(3);
    BlockCholesky system;
    for (const std::uint32_t n : {5u, 30u, 2u, 17u}) {
        const Pattern pattern = test::drawn_pattern(n, random);
        ASSERT_TRUE(system.analyse(n, pattern));
        test::expect_solves(pattern, random, system);
    }
}

TEST(BlockCholesky, EliminatesAChainWithoutFill) {
    Pattern chain;
    for (std::uint32_t i = 1; i < 50; ++i) chain.emplace_back(i - 1, i);
    BlockCholesky system;
    system.analyse(50, chain);
    // a diagonal block a row, a block below it for all but the last, and what that changes
    EXPECT_EQ(system.block_products(), 50u + 49 + 49);
}

TEST(BlockCholesky, SaysWhatIsNotPositive) {
    BlockCholesky system;
    system.analyse(2, {{0, 1}});
    system.clear();
    system.add(0, Matrix6d::Identity()), system.add(1, Matrix6d::Identity());
    system.add(0, 1, 2 * Matrix6d::Identity());
    EXPECT_FALSE(system.factor());
}

}  // namespace
}  // namespace plumb
