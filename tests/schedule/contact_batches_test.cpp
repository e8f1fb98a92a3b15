// SPDX-License-Identifier: MIT
#include "schedule/contact_batches.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <thread>

namespace plumb {
namespace {

constexpr std::int32_t kDynamic = 100, kZeroRow = 101;

std::vector<BodyPair> hub_and_others() {
    test::Random random(5);
    std::vector<BodyPair> pairs;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const auto a = i < 90 ? 0 : static_cast<std::int32_t>(random.below(kDynamic));
        auto b = static_cast<std::int32_t>(random.below(kDynamic + 1));
        if (a == b) b = (b + 1) % kDynamic;
        pairs.push_back({a, b, i, 1 + random.below(4), 0});
    }
    return pairs;
}

template <int W>
void expect_every_pair_in_its_lane() {
    const std::vector<BodyPair> pairs = hub_and_others();
    Colouring colouring;
    colouring.colour(pairs, kDynamic);
    ContactBatches<float, W> batches;
    batches.lay_out(pairs, colouring, ContactVariant::friction, kZeroRow);
    const ContactArrays<float, W> arrays = batches.arrays();

    std::set<std::pair<std::uint32_t, std::uint32_t>> places;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto slot = batches.slot(p);
        ASSERT_LT(slot.block, batches.block_count());
        EXPECT_TRUE(places.insert({slot.block, slot.lane}).second);
        const PairBlock<float, W>& block = arrays.blocks[slot.block];
        EXPECT_EQ(block.row_a[slot.lane], pairs[p].row_a);
        EXPECT_EQ(block.row_b[slot.lane], pairs[p].row_b);
        EXPECT_GE(block.row_count, pairs[p].count);
    }
    std::uint32_t rows = 0;
    for (std::uint32_t b = 0; b < batches.block_count(); ++b) {
        EXPECT_EQ(arrays.blocks[b].first_row, rows);
        rows += arrays.blocks[b].row_count;
        for (std::uint32_t lane = 0; lane < W; ++lane)
            if (!places.count({b, lane})) {
                EXPECT_EQ(arrays.blocks[b].row_a[lane], kZeroRow);
            }
    }
    EXPECT_FALSE(batches.ranges().back().independent);
    EXPECT_EQ(arrays.rollings, nullptr);
}

TEST(ContactBatches, EveryPairHasALaneAndRows) {
    expect_every_pair_in_its_lane<1>();
    expect_every_pair_in_its_lane<4>();
    expect_every_pair_in_its_lane<8>();
    expect_every_pair_in_its_lane<16>();
}

TEST(ContactBatches, FrictionlessScenesHaveNoTangentsInMemory) {
    const std::vector<BodyPair> pairs = hub_and_others();
    Colouring colouring;
    colouring.colour(pairs, kDynamic);
    ContactBatches<double, 4> batches;
    batches.lay_out(pairs, colouring, ContactVariant::frictionless, kZeroRow);
    EXPECT_EQ(batches.arrays().frictions, nullptr);
    EXPECT_NE(batches.arrays().normals, nullptr);
}

/// Whoever takes a block takes all of its contacts.
TEST(ContactBatches, WorkersVisitEachContactOnceAndShareNoBlock) {
    const std::vector<BodyPair> pairs = hub_and_others();
    Colouring colouring;
    colouring.colour(pairs, kDynamic);
    ContactBatches<float, 8> batches;
    batches.lay_out(pairs, colouring, ContactVariant::friction, kZeroRow);
    for (const std::uint32_t team : {1u, 2u, 3u}) {
        Workers workers(team);
        std::vector<std::vector<std::thread::id>> visitors(pairs.size());
        std::vector<std::uint32_t> most(pairs.size(), 0);
        batches.each_contact(pairs, workers, [&](const ContactPlace& at) {
            visitors[at.pair].push_back(std::this_thread::get_id());
            const auto slot = batches.slot(at.pair);
            EXPECT_EQ(at.block, slot.block);
            EXPECT_EQ(at.lane, slot.lane);
            most[at.pair] = std::max(most[at.pair], at.row);
        });
        std::map<std::uint32_t, std::set<std::thread::id>> of_block;
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            EXPECT_EQ(visitors[p].size(), pairs[p].count);
            const std::uint32_t block = batches.slot(p).block;
            EXPECT_EQ(most[p], batches.arrays().blocks[block].first_row + pairs[p].count - 1);
            of_block[block].insert(visitors[p].begin(), visitors[p].end());
        }
        for (const auto& [block, threads] : of_block) EXPECT_EQ(threads.size(), 1u);
    }
}

}  // namespace
}  // namespace plumb
