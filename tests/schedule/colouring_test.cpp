// SPDX-License-Identifier: MIT
#include "schedule/colouring.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace plumb {
namespace {

using test::Random;
constexpr std::int32_t kRows = 100;

std::vector<BodyPair> random_pairs(std::uint32_t count, std::uint32_t levels) {
    Random random(count + levels);
    std::vector<BodyPair> pairs;
    for (std::uint32_t i = 0; i < count; ++i) {
        // rows from 100 on are immovable
        const auto a = static_cast<std::int32_t>(random.below(110));
        auto b = static_cast<std::int32_t>(random.below(kRows));
        if (a == b) b = (b + 1) % kRows;
        pairs.push_back({a, b, i, 1 + random.below(4), random.below(levels)});
    }
    return pairs;
}

/// Each pair stands in exactly one batch, and batches follow each other without a gap.
void expect_complete(const Colouring& colouring, std::size_t pairs) {
    std::vector<std::uint32_t> seen = colouring.order();
    std::sort(seen.begin(), seen.end());
    ASSERT_EQ(seen.size(), pairs);
    for (std::uint32_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], i);
    std::uint32_t next = 0;
    for (const Batch& b : colouring.batches()) {
        EXPECT_EQ(b.first, next);
        EXPECT_LT(b.first, b.last);
        next = b.last;
    }
    EXPECT_EQ(next, pairs);
}

void expect_no_shared_body(const Colouring& colouring, const std::vector<BodyPair>& pairs) {
    for (const Batch& batch : colouring.batches()) {
        if (!batch.independent) continue;
        std::set<std::int32_t> bodies;
        for (std::uint32_t i = batch.first; i < batch.last; ++i)
            for (std::int32_t row :
                 {pairs[colouring.order()[i]].row_a, pairs[colouring.order()[i]].row_b})
                if (row < kRows) {
                    EXPECT_TRUE(bodies.insert(row).second) << "row " << row;
                }
    }
}

TEST(Colouring, NoDynamicBodyStandsTwiceInAnIndependentBatch) {
    for (std::uint32_t count : {1u, 10u, 400u, 3000u}) {
        const std::vector<BodyPair> pairs = random_pairs(count, 1);
        Colouring colouring;
        colouring.colour(pairs, kRows);
        expect_complete(colouring, pairs.size());
        expect_no_shared_body(colouring, pairs);
    }
}

TEST(Colouring, NoPairsMakeNoBatches) {
    Colouring colouring;
    colouring.colour(random_pairs(20, 1), kRows);
    colouring.colour(std::vector<BodyPair>(), kRows);
    EXPECT_TRUE(colouring.batches().empty());
    EXPECT_TRUE(colouring.order().empty());
}

TEST(Colouring, ImmovableBodiesDoNotCount) {
    std::vector<BodyPair> pairs;
    for (std::int32_t i = 0; i < kRows; ++i)
        pairs.push_back({kRows, i, static_cast<std::uint32_t>(i), 1, 0});
    Colouring colouring;
    colouring.colour(pairs, kRows);
    ASSERT_EQ(colouring.batches().size(), 1u);
    EXPECT_TRUE(colouring.batches()[0].independent);
}

TEST(Colouring, WhatFindsNoColourGoesToOneBatchInItsOrder) {
    std::vector<BodyPair> pairs;
    for (std::uint32_t i = 0; i < 99; ++i)  // all on body 0, the last with the most rows
        pairs.push_back({0, static_cast<std::int32_t>(i + 1), i, 1 + i, 0});
    Colouring colouring;
    colouring.colour(pairs, kRows);
    expect_complete(colouring, pairs.size());
    expect_no_shared_body(colouring, pairs);
    ASSERT_EQ(colouring.batches().size(), Colouring::kMaxColours + 1);
    const Batch overflow = colouring.batches().back();
    EXPECT_FALSE(overflow.independent);
    ASSERT_EQ(overflow.last - overflow.first, 99 - Colouring::kMaxColours);
    for (std::uint32_t i = overflow.first; i < overflow.last; ++i)
        EXPECT_EQ(colouring.order()[i], i);  // the first 63 have a colour each
}

TEST(Colouring, SixtyThreeOnOneBodyDoNotOverflow) {
    std::vector<BodyPair> pairs;
    for (std::uint32_t i = 0; i < Colouring::kMaxColours; ++i)
        pairs.push_back({0, static_cast<std::int32_t>(i + 1), i, 1, 0});
    Colouring colouring;
    colouring.colour(pairs, kRows);
    EXPECT_EQ(colouring.batches().size(), Colouring::kMaxColours);
    for (const Batch& b : colouring.batches()) EXPECT_TRUE(b.independent);
}

TEST(Colouring, LevelsFollowEachOther) {
    const std::vector<BodyPair> pairs = random_pairs(500, 7);
    Colouring colouring;
    colouring.colour(pairs, kRows);
    expect_complete(colouring, pairs.size());
    expect_no_shared_body(colouring, pairs);
    for (std::size_t i = 1; i < pairs.size(); ++i)
        EXPECT_LE(pairs[colouring.order()[i - 1]].level, pairs[colouring.order()[i]].level);
    for (const Batch& b : colouring.batches())
        for (std::uint32_t i = b.first; i < b.last; ++i)
            EXPECT_EQ(pairs[colouring.order()[i]].level, pairs[colouring.order()[b.first]].level);
}

TEST(Colouring, PairsWithMoreRowsComeFirst) {
    const std::vector<BodyPair> pairs = random_pairs(1000, 1);
    Colouring colouring;
    colouring.colour(pairs, kRows);
    for (const Batch& b : colouring.batches())
        for (std::uint32_t i = b.first + 1; i < b.last && b.independent; ++i)
            EXPECT_GE(pairs[colouring.order()[i - 1]].count, pairs[colouring.order()[i]].count);
}

template <int N>
std::vector<LinkedRows<N>> random_rows(std::uint32_t count) {
    Random random(count);
    std::vector<LinkedRows<N>> items(count);
    for (LinkedRows<N>& item : items) {
        std::set<std::int32_t> rows;  // from 100 on immovable, as often as they are drawn
        while (rows.size() < N) rows.insert(static_cast<std::int32_t>(random.below(110)));
        std::copy(rows.begin(), rows.end(), item.rows.begin());
        if (random.below(3) == 0) item.rows[random.below(N)] = 105;
    }
    return items;
}

template <int N>
void expect_no_shared_row(std::uint32_t count) {
    const std::vector<LinkedRows<N>> items = random_rows<N>(count);
    Colouring colouring;
    colouring.colour(items, kRows);
    expect_complete(colouring, items.size());
    for (const Batch& batch : colouring.batches()) {
        std::set<std::int32_t> moving;
        for (std::uint32_t i = batch.first; i < batch.last; ++i) {
            if (i > batch.first) {
                EXPECT_LT(colouring.order()[i - 1], colouring.order()[i]) << "not in their order";
            }
            for (const std::int32_t row : items[colouring.order()[i]].rows)
                if (batch.independent && row < kRows) {
                    EXPECT_TRUE(moving.insert(row).second) << "row " << row;
                }
        }
    }
}

TEST(Colouring, NoMovingRowOfThreeOrFourStandsTwiceInAnIndependentBatch) {
    for (const std::uint32_t count : {1u, 10u, 400u, 3000u}) {
        expect_no_shared_row<3>(count);
        expect_no_shared_row<4>(count);
    }
}

/// All share one point in one of their places: 63 find a colour, the others come last in order.
template <int N>
void expect_overflow_in_order() {
    std::vector<LinkedRows<N>> items(99);
    for (std::int32_t i = 0; i < 99; ++i) {
        LinkedRows<N>& item = items[static_cast<std::size_t>(i)];
        for (std::int32_t k = 0; k < N; ++k) item.rows[k] = 1 + N * i + k;
        item.rows[i % N] = 0;
    }
    Colouring colouring;
    colouring.colour(items, 1 + N * 99);
    expect_complete(colouring, items.size());
    ASSERT_EQ(colouring.batches().size(), Colouring::kMaxColours + 1);
    const Batch overflow = colouring.batches().back();
    EXPECT_FALSE(overflow.independent);
    ASSERT_EQ(overflow.last - overflow.first, 99 - Colouring::kMaxColours);
    for (std::uint32_t i = overflow.first; i < overflow.last; ++i)
        EXPECT_EQ(colouring.order()[i], i);
}

TEST(Colouring, WhatFindsNoColourAmongThreeOrFourStaysInItsOrder) {
    expect_overflow_in_order<3>();
    expect_overflow_in_order<4>();
}

TEST(Colouring, AUsedColouringGivesWhatAFreshOneGives) {
    Colouring used, fresh;
    used.colour(random_pairs(3000, 4), kRows);
    used.colour(random_pairs(400, 1), kRows);
    fresh.colour(random_pairs(400, 1), kRows);
    EXPECT_EQ(used.order(), fresh.order());
    ASSERT_EQ(used.batches().size(), fresh.batches().size());
}

}  // namespace
}  // namespace plumb
