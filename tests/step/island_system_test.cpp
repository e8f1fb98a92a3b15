// SPDX-License-Identifier: MIT
/// The systems of few and of many bodies against a dense one of the same matrix.
#include "step/island_system.h"
#include "step/island_account.h"
#include "support/random.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

namespace plumb {
namespace {

using test::Random;
using Pattern = IslandSystem::Pattern;

/// Masses, contacts of pairs, and rows of two bodies.
Eigen::MatrixXd fill(const Pattern& pattern, Random random, IslandSystem& system) {
    const std::uint32_t n = system.rows();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    system.clear();
    for (std::uint32_t i = 0; i < n; ++i) {
        const Matrix6d mass = random.number(0.5, 2) * Matrix6d::Identity();
        system.add(i, mass);
        dense.block<6, 6>(6 * i, 6 * i) += mass;
    }
    for (const auto& [i, j] : pattern) {
        Eigen::Matrix<double, 3, 6> a, b;
        for (int k = 0; k < a.size(); ++k) a(k) = random.number(-1, 1), b(k) = random.number(-1, 1);
        system.add(i, a.transpose() * a), system.add(j, b.transpose() * b);
        system.add(i, j, a.transpose() * b);
        Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(4, 6 * n);
        rows.block<3, 6>(0, 6 * i) = a, rows.block<3, 6>(0, 6 * j) = b;
        const Vector6d x = a.row(0), y = b.row(1);
        system.add_product(i, x, i, x), system.add_product(j, y, j, y);
        system.add_product(i, x, j, y);
        rows.block<1, 6>(3, 6 * i) = x.transpose(), rows.block<1, 6>(3, 6 * j) = y.transpose();
        dense += rows.transpose() * rows;
    }
    return dense;
}

void expect_solves(std::uint32_t rows, const Pattern& pattern, bool many, std::uint32_t seed) {
    Random random(seed);
    IslandSystem system;
    ASSERT_TRUE(system.analyse(rows, pattern, many, kAnyProducts));
    ASSERT_EQ(system.rows(), rows);
    const Eigen::MatrixXd dense = fill(pattern, random, system);
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

Pattern drawn_pattern(std::uint32_t rows, Random& random) {
    Pattern pattern;
    for (std::uint32_t k = 0; k < 3 * rows; ++k) {
        const std::uint32_t i = random.below(rows), j = random.below(rows);
        if (i != j) pattern.emplace_back(i, j);
    }
    return pattern;
}

TEST(IslandSystem, SolvesFewAndManyAlike) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        const std::uint32_t rows = 1 + random.below(40);
        const Pattern pattern = drawn_pattern(rows, random);
        for (const bool many : {false, true}) expect_solves(rows, pattern, many, seed + 100);
    }
}

/// What is refused leaves nothing, whatever was there before.
TEST(IslandSystem, RefusesWhatTakesTooMuch) {
    Random random(7);
    const Pattern pattern = drawn_pattern(30, random);
    for (const bool before : {false, true})
        for (const bool many : {false, true}) {
            IslandSystem system;
            ASSERT_TRUE(system.analyse(30, pattern, before, kAnyProducts));
            ASSERT_TRUE(system.analyse(30, pattern, many, kAnyProducts));
            const std::uint64_t needed = system.block_products();
            EXPECT_GT(needed, 30u + pattern.size() / 2);
            ASSERT_TRUE(system.analyse(30, pattern, before, kAnyProducts));
            EXPECT_TRUE(system.analyse(30, pattern, many, needed));
            ASSERT_TRUE(system.analyse(30, pattern, before, kAnyProducts));
            EXPECT_FALSE(system.analyse(30, pattern, many, needed / 3));
            EXPECT_EQ(system.rows(), 0u);
        }
}

}  // namespace
}  // namespace plumb
