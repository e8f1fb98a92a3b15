// SPDX-License-Identifier: MIT
/// The elimination of fronts against a dense factorisation of the same matrix.
#include "math/sparse_ldlt.h"
#include "kernels/front_kernels.h"
#include "support/random.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

using test::Random;
using Pattern = std::vector<SparseLdlt::Pair>;

Matrix3d any_block(Random& random) {
    Matrix3d block;
    for (int k = 0; k < 9; ++k) block(k) = random.number(-1, 1);
    return block;
}

/// Systems with random blocks on a pattern, and attached rows with a sign of their own.
struct Systems {
    SparseLdlt sparse;
    Eigen::MatrixXd dense;
    Random random;
    Pattern pattern;

    Systems(std::uint32_t rows, Pattern of, std::uint32_t seed,
            const FrontKernels& kernels = front_kernels())
        : sparse(kernels), random(seed), pattern(std::move(of)) {
        sparse.order(rows, pattern);
    }

    void attach(std::uint32_t more, std::uint32_t each) {
        const std::uint32_t n = sparse.rows();
        attached.clear();
        for (std::uint32_t row = n; row < n + more; ++row)
            for (std::uint32_t k = 0; k < each; ++k)
                attached.emplace_back(static_cast<std::uint32_t>(random.number(0, n - 1e-9)), row);
        std::sort(attached.begin(), attached.end());
        attached.erase(std::unique(attached.begin(), attached.end()), attached.end());
        sparse.attach(more, attached);
    }

    void fill(double sign_of_attached) {
        const std::uint32_t n = sparse.rows(), all = n + sparse.more();
        dense = Eigen::MatrixXd::Zero(3 * all, 3 * all);
        sparse.clear();
        const auto put = [&](std::uint32_t i, std::uint32_t j, const Matrix3d& block) {
            dense.block<3, 3>(3 * i, 3 * j) += block;
            if (i != j) dense.block<3, 3>(3 * j, 3 * i) += block.transpose();
        };
        for (std::uint32_t i = 0; i < all; ++i) {
            const Matrix3d block = any_block(random);
            const Matrix3d heavy = (i < n ? 1 : sign_of_attached) *
                                   (block * block.transpose() + 40 * Matrix3d::Identity());
            sparse.add(i, heavy), put(i, i, heavy);
        }
        for (const auto& [i, j] : pattern) {
            const Matrix3d block = any_block(random);
            sparse.add(sparse.slot(i, j), block), put(i, j, block);
        }
        for (std::size_t k = 0; k < attached.size(); ++k) {
            const Matrix3d block = any_block(random);
            sparse.add_pair(k, block), put(attached[k].first, attached[k].second, block);
        }
        for (std::uint32_t i = n; i < all; ++i)
            for (std::uint32_t j = n; j < i; ++j) {
                const Matrix3d block = any_block(random);
                if ((i + j) % 2)
                    sparse.add_more(i, j, block);
                else
                    sparse.add_more(j, i, block.transpose());
                put(i, j, block);
            }
    }

    std::vector<Vector3d> solve(const Eigen::VectorXd& right) {
        std::vector<Vector3d> x;
        for (Eigen::Index i = 0; i < right.size(); i += 3) x.push_back(right.segment<3>(i));
        EXPECT_TRUE(sparse.factor());
        sparse.solve(x);
        return x;
    }

    void expect_solved() {
        const std::uint32_t all = sparse.rows() + sparse.more();
        Eigen::VectorXd right(3 * all);
        for (auto& x : right) x = random.number(-1, 1);
        const std::vector<Vector3d> x = solve(right);
        const Eigen::VectorXd expected = dense.partialPivLu().solve(right);
        for (std::uint32_t i = 0; i < all; ++i)
            EXPECT_LT((x[i] - expected.segment<3>(3 * i)).norm(), 1e-9 * expected.norm()) << i;
    }

    Pattern attached;
};

Pattern grid(std::uint32_t n) {
    Pattern pattern;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t at = i * n + j;
            if (i + 1 < n) pattern.emplace_back(at, at + n);
            if (j + 1 < n) pattern.emplace_back(at + 1, at);
            if (i + 1 < n && j + 1 < n) pattern.emplace_back(at, at + n + 1);
        }
    return pattern;
}

TEST(SparseLdlt, SolvesChainsGridsAndPieces) {
    for (const std::uint32_t n : {1u, 2u, 9u, 40u}) {
        Pattern chain;
        for (std::uint32_t i = 1; i < n; ++i) chain.emplace_back(i, i - 1);
        Systems s(n, chain, n);
        s.fill(1), s.expect_solved();
    }
    for (const std::uint32_t n : {2u, 5u, 13u}) {
        Systems s(n * n, grid(n), n);
        s.fill(1), s.expect_solved();
        s.fill(1), s.expect_solved();
    }
    // pieces that have nothing to do with each other, and rows with nobody
    Pattern pieces = grid(4);
    for (const auto& [i, j] : grid(3)) pieces.emplace_back(i + 20, j + 20);
    Systems s(31, pieces, 7);
    s.fill(1), s.expect_solved();
}

TEST(SparseLdlt, OrdersOnePatternAfterAnother) {
    Systems s(25, grid(5), 11);
    for (const std::uint32_t n : {13u, 3u, 9u, 1u, 10u}) {
        s.pattern = grid(n), s.attached.clear();
        s.sparse.order(n * n, s.pattern);
        s.fill(1), s.expect_solved();
        s.attach(2, n);
        s.fill(1), s.expect_solved();
    }
}

TEST(SparseLdlt, SolvesWithRowsThatComeAndGo) {
    Systems s(81, grid(9), 3);
    for (const auto& [more, each] : std::vector<std::pair<std::uint32_t, std::uint32_t>>{
             {1, 1}, {4, 9}, {12, 3}, {0, 0}, {2, 70}}) {
        s.attach(more, each);
        s.fill(1), s.expect_solved();
        s.fill(-1), s.expect_solved();  // quasi-definite, as multipliers are
    }
}

TEST(SparseLdlt, RandomPatterns) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        Random random(seed);
        const auto n = static_cast<std::uint32_t>(random.number(3, 60));
        Pattern pattern;
        for (std::uint32_t k = 0; k < 2 * n; ++k) {
            const auto i = static_cast<std::uint32_t>(random.number(0, n - 1e-9)),
                       j = static_cast<std::uint32_t>(random.number(0, n - 1e-9));
            if (i != j) pattern.emplace_back(i, j);
        }
        Systems s(n, pattern, seed);
        s.attach(seed % 4, 5);
        s.fill(seed % 2 ? 1 : -1), s.expect_solved();
    }
}

TEST(SparseLdlt, SameBitsInAnyRegisters) {
    for (const std::uint32_t n : {3u, 8u, 17u}) {
        std::vector<std::vector<Vector3d>> found;
        for (const FrontKernels& kernels : {front_kernels_of<2>(), front_kernels()}) {
            Systems s(n * n, grid(n), n, kernels);
            s.attach(5, n);
            s.fill(1);
            found.push_back(s.solve(Eigen::VectorXd::LinSpaced(3 * (n * n + 5), -1, 1)));
        }
        EXPECT_EQ(found[0], found[1]);
    }
}

TEST(SparseLdlt, SaysThatAPivotIsZero) {
    SparseLdlt system;
    system.order(3, {{0, 1}, {1, 2}});
    system.clear();
    EXPECT_FALSE(system.factor());
}

TEST(SparseLdlt, GrowsAboutAsNestedDissectionDoes) {
    // n^1.5 is the best for a grid of n points (George 1973), a band takes n²
    const auto work = [](std::uint32_t side) {
        SparseLdlt system;
        system.order(side * side, grid(side));
        return system.work();
    };
    EXPECT_LT(work(80) / work(20), std::pow(16, 1.75));
}

}  // namespace
}  // namespace plumb
