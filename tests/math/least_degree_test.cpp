// SPDX-License-Identifier: MIT
/// The order of least degree against Eigen's, from which it must not differ: ties are broken alike.
#include "math/least_degree.h"
#include "support/block_system.h"

#include <gtest/gtest.h>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace plumb {
namespace {

using test::Random;
using Pairs = RowGraph::Pairs;

std::vector<std::uint32_t> order_of_eigen(std::uint32_t rows, const Pairs& pairs) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::uint32_t i = 0; i < rows; ++i)
        entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1.0);
    for (const auto& [i, j] : pairs) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), 1.0);
        entries.emplace_back(static_cast<int>(j), static_cast<int>(i), 1.0);
    }
    Eigen::SparseMatrix<double> matrix(static_cast<int>(rows), static_cast<int>(rows));
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> found;
    Eigen::AMDOrdering<int>()(matrix, found);
    return {found.indices().begin(), found.indices().end()};
}

/// One after another in the same memory.
void expect_order(std::uint32_t rows, const Pairs& pairs, RowGraph& graph, LeastDegree& least) {
    std::vector<std::uint32_t> order;
    graph.build(rows, pairs);
    least.find(graph, order);
    EXPECT_EQ(order, order_of_eigen(rows, pairs)) << rows << " rows";
}

TEST(LeastDegree, IsTheOrderOfEigen) {
    RowGraph graph;
    LeastDegree least;
    for (std::uint32_t seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const std::uint32_t rows = 1 + random.below(seed % 3 ? 30 : 300);
        Pairs pairs;
        for (std::uint32_t k = random.below(4 * rows); k-- > 0;)
            pairs.emplace_back(random.below(rows), random.below(rows));
        // some rows have entries with nearly all
        for (std::uint32_t many = std::min(rows, random.below(3)); many-- > 0;)
            for (std::uint32_t i = 0; i < rows; ++i) pairs.emplace_back(many, i);
        expect_order(rows, pairs, graph, least);
    }
}

TEST(LeastDegree, IsTheOrderOfEigenOnBlocksOfPoints) {
    RowGraph graph;
    LeastDegree least;
    for (const std::uint32_t n : {2u, 5u, 12u}) {
        Pairs pairs;
        const auto at = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            return (i * n + j) * n + k;
        };
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j)
                for (std::uint32_t k = 0; k < n; ++k)
                    for (std::uint32_t c = 1; c < 8; ++c) {
                        const std::uint32_t x = i + (c & 1), y = j + (c >> 1 & 1), z = k + (c >> 2);
                        if (std::max({x, y, z}) < n) pairs.emplace_back(at(i, j, k), at(x, y, z));
                    }
        expect_order(n * n * n, pairs, graph, least);
    }
}

}  // namespace
}  // namespace plumb
