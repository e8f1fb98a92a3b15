// SPDX-License-Identifier: MIT
/// Sparse systems of 6 × 6 blocks against a dense one of the same matrix.
#pragma once

#include "math/types.h"
#include "support/random.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <vector>

namespace plumb::test {

/// A sum of squares on the pattern's blocks, positive definite and with no other block: masses,
/// contacts of pairs, and rows of both bodies. Returns it as a dense one.
template <class System>
Eigen::MatrixXd fill(const typename System::Pattern& pattern, Random& random, System& system) {
    const std::uint32_t n = system.rows();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6 * n, 6 * n);
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
        const Vector6d x = a.row(0), y = b.row(1);
        system.add_product(i, x, i, x), system.add_product(j, y, j, y);
        system.add_product(i, x, j, y);
        Eigen::VectorXd row = Eigen::VectorXd::Zero(6 * n);
        row.segment<6>(6 * i) = x, row.segment<6>(6 * j) = y;
        dense += row * row.transpose();
    }
    return dense;
}

/// With drawn numbers on the pattern that it was analysed for, and a drawn right side.
template <class System>
void expect_solves(const typename System::Pattern& pattern, Random& random, System& system) {
    const std::uint32_t rows = system.rows();
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

/// Pairs of so many rows; some come twice.
inline std::vector<std::pair<std::uint32_t, std::uint32_t>> drawn_pattern(std::uint32_t rows,
                                                                          Random& random) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pattern;
    for (std::uint32_t k = 0; k < 3 * rows; ++k) {
        const std::uint32_t i = random.below(rows), j = random.below(rows);
        if (i != j) pattern.emplace_back(i, j);
    }
    return pattern;
}

}  // namespace plumb::test
