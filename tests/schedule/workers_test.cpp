// SPDX-License-Identifier: MIT
#include "schedule/workers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace plumb {
namespace {

constexpr std::uint32_t kTeams[] = {1, 2, 3, 5};

TEST(Workers, SharesCoverAllItemsOnceAndAreEven) {
    for (std::uint32_t team : {1u, 2u, 3u, 7u, 16u}) {
        const Workers workers(team);
        for (std::uint32_t items : {0u, 1u, 5u, 16u, 1000003u, 4000000000u}) {
            std::uint32_t next = 0;
            for (std::uint32_t w = 0; w < team; ++w) {
                const Range share = workers.share(items, w);
                EXPECT_EQ(share.first, next);
                EXPECT_LE(share.last - share.first, items / team + 1);
                next = share.last;
            }
            EXPECT_EQ(next, items);
        }
    }
}

TEST(Workers, RunCallsEveryWorkerOnceAndWaitsForAll) {
    for (std::uint32_t team : kTeams) {
        Workers workers(team);
        EXPECT_EQ(workers.count(), team);
        std::vector<int> calls(team, 0);
        for (int round = 1; round <= 200; ++round) {
            workers.run([&](std::uint32_t worker) { ++calls[worker]; });
            for (int c : calls) ASSERT_EQ(c, round);
        }
    }
}

/// What the others wrote before a barrier is there after it.
TEST(Workers, NobodyPassesABarrierBeforeAllHaveComeToIt) {
    for (std::uint32_t team : kTeams) {
        Workers workers(team);
        std::vector<int> phase(team, 0);
        std::vector<int> early(team, 0);
        workers.run([&](std::uint32_t worker) {
            for (int p = 1; p <= 200; ++p) {
                phase[worker] = p;
                workers.barrier();
                for (int other : phase) early[worker] += other != p;
                workers.barrier();
            }
        });
        for (int e : early) EXPECT_EQ(e, 0);
    }
}

TEST(Workers, EachVisitsAllItemsOnceOnTheWorkerWhoseShareTheyAreIn) {
    for (std::uint32_t team : kTeams) {
        Workers workers(team);
        for (std::size_t items : {0u, 1u, 100u, 1000u, 10007u}) {
            std::vector<int> visits(items, 0);
            std::vector<std::uint32_t> by(items, 0);
            workers.each(
                items, [&](std::uint32_t i, std::uint32_t worker) { ++visits[i], by[i] = worker; });
            for (std::size_t i = 0; i < items; ++i) {
                EXPECT_EQ(visits[i], 1);
                EXPECT_LT(by[i], team);
            }
            EXPECT_TRUE(std::is_sorted(by.begin(), by.end()));
            if (items > 1000) {
                EXPECT_EQ(by.back(), team - 1);
            }
        }
    }
}

TEST(Workers, NoneAreTakenForOne) { EXPECT_EQ(Workers(0).count(), 1u); }

TEST(Workers, AnIdleTeamGoesAway) {
    for (int i = 0; i < 20; ++i) Workers workers(3);
}

}  // namespace
}  // namespace plumb
