// SPDX-License-Identifier: MIT
/// The sparse factorisation against a dense one of the same matrix.
#include "math/block_cholesky.h"
#include "support/random.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

namespace plumb {
namespace {

using test::Random;
using Pattern = BlockCholesky::Pattern;

/// A sum of squares on the pattern's blocks: positive definite and with no other block.
void fill(const Pattern& pattern, Random& random, BlockCholesky& system, Eigen::MatrixXd& dense) {
    const std::uint32_t n = system.rows();
    dense = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    system.clear();
    for (std::uint32_t i = 0; i < n; ++i) {
        const Matrix6d block = random.number(0.5, 2) * Matrix6d::Identity();
        system.add(i, block);
        dense.block<6, 6>(6 * i, 6 * i) += block;
    }
    for (const auto& [i, j] : pattern) {
        Eigen::Matrix<double, 3, 6> a, b;
        for (int k = 0; k < a.size(); ++k) a(k) = random.number(-1, 1), b(k) = random.number(-1, 1);
        system.add(i, a.transpose() * a), system.add(j, b.transpose() * b);
        system.add(i, j, a.transpose() * b);
        dense.block<6, 6>(6 * i, 6 * i) += a.transpose() * a;
        dense.block<6, 6>(6 * j, 6 * j) += b.transpose() * b;
        dense.block<6, 6>(6 * i, 6 * j) += a.transpose() * b;
        dense.block<6, 6>(6 * j, 6 * i) += b.transpose() * a;
        // a row of both bodies
        const Vector6d x = a.row(0), y = b.row(1);
        system.add_product(i, x, i, x), system.add_product(j, y, j, y);
        system.add_product(i, x, j, y);
        Eigen::VectorXd row = Eigen::VectorXd::Zero(6 * n);
        row.segment<6>(6 * i) = x, row.segment<6>(6 * j) = y;
        dense += row * row.transpose();
    }
}

void expect_solves(std::uint32_t rows, const Pattern& pattern, std::uint32_t seed) {
    Random random(seed);
    BlockCholesky system;
    system.analyse(rows, pattern);
    for (int again = 0; again < 2; ++again) {
        Eigen::MatrixXd dense;
        fill(pattern, random, system, dense);
        Eigen::VectorXd right(6 * rows);
        for (auto& x : right) x = random.number(-1, 1);
        std::vector<Vector6d> x(rows);
        for (std::uint32_t i = 0; i < rows; ++i) x[i] = right.segment<6>(6 * i);
        ASSERT_TRUE(system.factor());
        system.solve(x);
        const Eigen::VectorXd expected = dense.llt().solve(right);
        for (std::uint32_t i = 0; i < rows; ++i)
            EXPECT_LT((x[i] - expected.segment<6>(6 * i)).norm(), 1e-9 * expected.norm());
    }
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
        Pattern pattern;
        for (std::uint32_t k = 0; k < 3 * n; ++k) {
            const std::uint32_t i = random.below(n), j = random.below(n);
            if (i != j) pattern.emplace_back(i, j);
        }
        expect_solves(n, pattern, seed + 1000);
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
