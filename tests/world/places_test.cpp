// SPDX-License-Identifier: MIT
/// Identifiers and places against a plain map, through many random comings and goings.
#include "world/places.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace plumb::test {
namespace {

TEST(Places, AreTheIdentifiersUntilSomethingIsRemoved) {
    Places places;
    for (std::uint32_t i = 0; i < 5; ++i) {
        const Places::Entry entry = places.add();
        EXPECT_EQ(entry.id, i);
        EXPECT_EQ(entry.place, i);
    }
    EXPECT_EQ(places.size(), 5u);
    EXPECT_FALSE(places.find(5));
    EXPECT_FALSE(places.knew(5));
}

TEST(Places, TheLowestVacantOneIsTakenNext) {
    Places places;
    for (int i = 0; i < 6; ++i) places.add();
    places.remove(3), places.remove(1);
    EXPECT_EQ(places.add().place, 1u);
    EXPECT_EQ(places.add().place, 3u);
    EXPECT_EQ(places.add().place, 6u);
    EXPECT_EQ(places.find(6), 1u);
    EXPECT_EQ(places.find(7), 3u);
    EXPECT_FALSE(places.find(1));
    EXPECT_TRUE(places.knew(1));
}

TEST(Places, VacantOnesAtTheEndFallAway) {
    Places places;
    for (int i = 0; i < 6; ++i) places.add();
    places.remove(4), places.remove(3);
    EXPECT_EQ(places.size(), 6u);
    places.remove(5);
    EXPECT_EQ(places.size(), 3u);
    EXPECT_EQ(places.add().place, 3u);
}

TEST(Places, AgreeWithAMap) {
    std::mt19937 random(1);
    Places places;
    std::map<std::uint32_t, std::uint32_t> living;
    std::uint32_t added = 0;
    for (int i = 0; i < 20000; ++i) {
        if (living.empty() || random() % 100 < 51) {
            const Places::Entry entry = places.add();
            EXPECT_EQ(entry.id, added++);
            for (const auto& [id, place] : living) ASSERT_NE(place, entry.place);
            living[entry.id] = entry.place;
        } else {
            const auto at = std::next(living.begin(), random() % living.size());
            places.remove(at->first);
            living.erase(at);
        }
        std::uint32_t end = 0;
        for (const auto& [id, place] : living) {
            ASSERT_EQ(places.find(id), place);
            end = std::max(end, place + 1);
        }
        ASSERT_EQ(places.size(), end);
    }
}

}  // namespace
}  // namespace plumb::test
