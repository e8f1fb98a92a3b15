// SPDX-License-Identifier: MIT
#include "islands/island_account.h"

#include <gtest/gtest.h>

namespace plumb {
namespace {

/// Products of a factorisation of a heap; bodies of a large one, and what they take in a substep.
constexpr std::uint64_t kProducts = 1000;
constexpr std::uint32_t kBodies = 1000;
const std::uint64_t kMostProducts = most_products(kBodies);

/// The same account in the next step, as contacts remember it.
IslandAccount next_step(const IslandAccount& account, IslandAccount fresh) {
    fresh.recall(account.missed());
    return fresh;
}

/// Returns whether the island is given up after a substep that took so many products.
bool is_given_up_after(IslandAccount& account, std::uint64_t products, bool solved) {
    account.begin_substep();
    account.take(products);
    return account.end_substep(solved);
}

/// Steps of sweeps until what is remembered waits no more.
int steps_that_wait(std::uint8_t missed) {
    int steps = 0;
    for (; waits(missed); ++steps) missed = missed_after_sweeps(missed, steps);
    return steps;
}

TEST(IslandAccount, IsNotKeptOfWhatTakesWhatItNeeds) {
    IslandAccount account;
    EXPECT_FALSE(account.is_kept());
    for (int i = 0; i < 1000; ++i) EXPECT_FALSE(is_given_up_after(account, kMostProducts, false));
    EXPECT_EQ(account.missed(), 0);
}

TEST(IslandAccount, GivesUpALargeIslandAfterSixtyUnitsInVain) {
    IslandAccount account = IslandAccount::of_large(kBodies, kProducts);
    for (int i = 0; i < kMostInVain; ++i)
        EXPECT_FALSE(is_given_up_after(account, kLargeUnit, false)) << "substep " << i;
    EXPECT_TRUE(is_given_up_after(account, kLargeUnit, false));
    EXPECT_TRUE(account.is_given_up());
    EXPECT_EQ(account.missed(), kInVain);
}

/// Sixty of its own factorisations, where one takes more than a unit.
TEST(IslandAccount, GivesUpAVeryLargeIslandAfterSixtyFactorisationsInVain) {
    constexpr std::uint64_t kGreat = 4 * kLargeUnit;
    IslandAccount account = IslandAccount::of_large(10'000, kGreat);
    EXPECT_EQ(most_products(10'000), 500'000'000u);
    for (int i = 0; i < kMostInVain; ++i)
        EXPECT_FALSE(is_given_up_after(account, kGreat, false)) << "substep " << i;
    EXPECT_TRUE(is_given_up_after(account, kGreat, false));
}

TEST(IslandAccount, GivesUpAHeapAfter160FactorisationsInVain) {
    IslandAccount account = IslandAccount::of_heap(kProducts);
    for (int i = 0; i < 160; ++i)
        EXPECT_FALSE(is_given_up_after(account, kProducts, false)) << "substep " << i;
    EXPECT_TRUE(is_given_up_after(account, kProducts, false));
    EXPECT_EQ(account.missed(), kHeapInVain);
}

TEST(IslandAccount, BeginsAnewOnceTheIslandIsSolved) {
    IslandAccount account = IslandAccount::of_heap(kProducts);
    for (int i = 0; i < 1000; ++i)
        EXPECT_FALSE(is_given_up_after(account, 100 * kProducts, i % 2 == 1)) << "substep " << i;
    EXPECT_EQ(account.missed(), kMissed);
}

TEST(IslandAccount, OfALargeIslandBoundsASubstep) {
    IslandAccount account = IslandAccount::of_large(kBodies, kProducts);
    account.begin_substep();
    EXPECT_EQ(account.left(), kMostProducts);
    account.take(2 * kMostProducts);
    EXPECT_EQ(account.left(), 0u);
    EXPECT_FALSE(account.end_substep(false)) << "40 units, however much it took";
    account.begin_substep();
    EXPECT_EQ(account.left(), kMostProducts);
}

TEST(IslandAccount, GoesOnFromStepToStep) {
    IslandAccount account = IslandAccount::of_heap(kProducts);
    for (int i = 0; i < kMostOfHeap; ++i) {
        EXPECT_FALSE(is_given_up_after(account, kHeapUnit * kProducts, false)) << "step " << i;
        account = next_step(account, IslandAccount::of_heap(kProducts));
    }
    EXPECT_TRUE(is_given_up_after(account, kHeapUnit * kProducts, false));
}

TEST(IslandAccount, ForgetsWhatAStepMayTakeFreely) {
    IslandAccount account = IslandAccount::of_large(kBodies, kProducts);
    for (int i = 0; i < 1000; ++i) {
        ASSERT_FALSE(is_given_up_after(account, kFreeUnits * kLargeUnit, false)) << "step " << i;
        EXPECT_EQ(account.missed(), kMissed);
        account = next_step(account, IslandAccount::of_large(kBodies, kProducts));
    }
}

TEST(IslandAccount, RecallsTheWorstOfItsContactsButNotWhatWaits) {
    IslandAccount account = IslandAccount::of_large(kBodies, kProducts);
    for (const int units : {3, 20, 7}) account.recall(static_cast<std::uint8_t>(kMissed + units));
    for (const std::uint8_t missed : {kTriesAgain, kHeapInVain, kInVain}) account.recall(missed);
    account.begin_substep();
    EXPECT_FALSE(account.end_substep(false));
    EXPECT_EQ(account.missed(), kMissed + 20 - kFreeUnits);
}

TEST(IslandAccount, WaitsOnceItsIslandIsGivenUp) {
    EXPECT_EQ(steps_that_wait(0), 0);
    EXPECT_EQ(steps_that_wait(kMissed + kMostInVain), 0);
    EXPECT_NEAR(steps_that_wait(kTriesAgain), 128, 8);
    EXPECT_NEAR(steps_that_wait(kHeapInVain), 256, 8);
    EXPECT_NEAR(steps_that_wait(kInVain), 1552, 8);
    EXPECT_EQ(missed_after_sweeps(kMissed, 1), 0) << "what is swept has taken nothing in vain";
}

}  // namespace
}  // namespace plumb
