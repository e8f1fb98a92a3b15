// SPDX-License-Identifier: MIT
/// Identifiers and slots against a plain map, through many random comings and goings.
#include "world/slot_map.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace plumb::test {
namespace {

TEST(SlotMap, SlotsAreTheIdentifiersUntilSomethingIsRemoved) {
    SlotMap slots;
    for (std::uint32_t i = 0; i < 5; ++i) {
        const SlotMap::Entry entry = slots.add();
        EXPECT_EQ(entry.id, i);
        EXPECT_EQ(entry.slot, i);
    }
    EXPECT_EQ(slots.size(), 5u);
    EXPECT_FALSE(slots.find(5));
    EXPECT_FALSE(slots.knew(5));
}

TEST(SlotMap, TheLowestVacantSlotIsTakenNext) {
    SlotMap slots;
    for (int i = 0; i < 6; ++i) slots.add();
    slots.remove(3), slots.remove(1);
    EXPECT_EQ(slots.add().slot, 1u);
    EXPECT_EQ(slots.add().slot, 3u);
    EXPECT_EQ(slots.add().slot, 6u);
    EXPECT_EQ(slots.find(6), 1u);
    EXPECT_EQ(slots.find(7), 3u);
    EXPECT_FALSE(slots.find(1));
    EXPECT_TRUE(slots.knew(1));
}

TEST(SlotMap, VacantSlotsAtTheEndFallAway) {
    SlotMap slots;
    for (int i = 0; i < 6; ++i) slots.add();
    slots.remove(4), slots.remove(3);
    EXPECT_EQ(slots.size(), 6u);
    slots.remove(5);
    EXPECT_EQ(slots.size(), 3u);
    EXPECT_EQ(slots.add().slot, 3u);
}

TEST(SlotMap, AgreesWithAMap) {
    std::mt19937 random(1);
    SlotMap slots;
    std::map<std::uint32_t, std::uint32_t> living;
    std::uint32_t added = 0;
    for (int i = 0; i < 20000; ++i) {
        if (living.empty() || random() % 100 < 51) {
            const SlotMap::Entry entry = slots.add();
            EXPECT_EQ(entry.id, added++);
            for (const auto& [id, slot] : living) ASSERT_NE(slot, entry.slot);
            living[entry.id] = entry.slot;
        } else {
            const auto at = std::next(living.begin(), random() % living.size());
            slots.remove(at->first);
            living.erase(at);
        }
        std::uint32_t end = 0;
        for (const auto& [id, slot] : living) {
            ASSERT_EQ(slots.find(id), slot);
            end = std::max(end, slot + 1);
        }
        ASSERT_EQ(slots.size(), end);
    }
}

}  // namespace
}  // namespace plumb::test
