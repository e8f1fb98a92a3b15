// SPDX-License-Identifier: MIT
/// Fill against an elimination of all rows one by one.
#include "math/fill.h"
#include "support/block_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace plumb {
namespace {

using test::Random;
using Columns = std::vector<std::vector<std::uint32_t>>;

std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> place(order.size());
    for (std::uint32_t p = 0; p < order.size(); ++p) place[order[p]] = p;
    return place;
}

/// What is eliminated makes those after it neighbours of each other.
Columns eliminated(const RowGraph& graph, const std::vector<std::uint32_t>& order) {
    const std::vector<std::uint32_t> place = inverse(order);
    std::vector<std::set<std::uint32_t>> below(order.size());
    for (std::uint32_t p = 0; p < order.size(); ++p)
        for (const std::uint32_t row : graph.near(order[p]))
            if (place[row] > p) below[p].insert(place[row]);
    Columns columns;
    for (const auto& rows : below) {
        columns.emplace_back(rows.begin(), rows.end());
        for (const std::uint32_t row : rows)
            below[row].insert(std::next(rows.find(row)), rows.end());
    }
    return columns;
}

TEST(Fill, IsThatOfAnEliminationRowByRow) {
    Fill fill;
    RowGraph graph;
    for (std::uint32_t seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        const std::uint32_t rows = 1 + random.below(60);
        RowGraph::Pairs pairs = test::drawn_pattern(rows, random);
        pairs.resize(random.below(static_cast<std::uint32_t>(pairs.size()) + 1));
        graph.build(rows, pairs);

        std::vector<std::uint32_t> order(rows);
        std::iota(order.rbegin(), order.rend(), 0);
        const Columns before = eliminated(graph, order);
        fill.put_children_first(order, graph, inverse(order));
        const Columns expected = eliminated(graph, order);

        std::vector<std::uint32_t> own_first, own;
        const std::vector<std::uint32_t> place = inverse(order);
        double products = 0;
        for (std::uint32_t p = 0; p < rows; ++p) {
            own_first.push_back(static_cast<std::uint32_t>(own.size()));
            for (const std::uint32_t row : graph.near(order[p]))
                if (place[row] > p) own.push_back(place[row]);
            std::sort(own.begin() + own_first.back(), own.end());
            const auto size = static_cast<double>(expected[p].size());
            products += size * (size + 1) / 2;
        }
        own_first.push_back(static_cast<std::uint32_t>(own.size()));
        ASSERT_TRUE(fill.find(own_first, own, products));
        for (std::uint32_t p = 0; p < rows; ++p) {
            EXPECT_TRUE(std::ranges::equal(fill.below(p), expected[p])) << p;
            // columns in between are of the same tree
            if (expected[p].empty()) continue;
            for (std::uint32_t q = p + 1; q < expected[p][0]; ++q)
                EXPECT_LE(expected[q].at(0), expected[p][0]);
        }
        const auto entries = [](const Columns& columns) {
            std::size_t sum = 0;
            for (const auto& column : columns) sum += column.size();
            return sum;
        };
        EXPECT_EQ(entries(before), entries(expected));
        if (products > 0) {
            EXPECT_FALSE(fill.find(own_first, own, products - 1));
        }
    }
}

}  // namespace
}  // namespace plumb
