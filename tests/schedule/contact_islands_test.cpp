// SPDX-License-Identifier: MIT
#include "schedule/contact_islands.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace plumb {
namespace {

using test::Random;
constexpr std::int32_t kFree = 60;

/// The least row of each row's island, by spreading it along the pairs until nothing changes.
std::vector<std::int32_t> least_rows(const std::vector<BodyPair>& pairs) {
    std::vector<std::int32_t> least(kFree);
    std::iota(least.begin(), least.end(), 0);
    for (bool changed = true; changed;) {
        changed = false;
        for (const BodyPair& p : pairs) {
            if (p.row_a >= kFree || p.row_b >= kFree) continue;
            const std::int32_t to = std::min(least[p.row_a], least[p.row_b]);
            changed |= least[p.row_a] != to || least[p.row_b] != to;
            least[p.row_a] = least[p.row_b] = to;
        }
    }
    return least;
}

TEST(ContactIslands, AreWhatHangsTogetherThroughDynamicBodies) {
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        Random random(seed);
        std::vector<BodyPair> pairs;
        for (std::uint32_t i = 0; i < 2 * seed; ++i) {
            const auto a = static_cast<std::int32_t>(random.below(kFree + 5));
            const auto b = static_cast<std::int32_t>(random.below(kFree + 5));
            if (a != b) pairs.push_back({a, b, i, 1});
        }
        ContactIslands islands;
        islands.find(pairs, {}, 0, kFree);

        const std::vector<std::int32_t> least = least_rows(pairs);
        std::map<std::int32_t, std::size_t> bodies, of_pairs;
        std::vector<bool> touches(kFree, false);
        for (const BodyPair& p : pairs) {
            for (std::int32_t row : {p.row_a, p.row_b})
                if (row < kFree) touches[row] = true;
            const std::int32_t row = p.row_a < kFree ? p.row_a : p.row_b;
            if (row < kFree) ++of_pairs[least[row]];
        }
        for (std::int32_t row = 0; row < kFree; ++row)
            if (touches[row]) ++bodies[least[row]];

        ASSERT_EQ(islands.islands().size(), bodies.size());
        std::int32_t before = -1;
        for (const ContactIsland& island : islands.islands()) {
            const std::int32_t first = islands.bodies()[island.first_body];
            EXPECT_GT(first, before) << "islands stand in the order of their first body";
            before = first;
            EXPECT_EQ(least[first], first);
            EXPECT_EQ(island.last_body - island.first_body, bodies[first]);
            EXPECT_EQ(island.last_pair - island.first_pair, of_pairs[first]);
            for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
                EXPECT_EQ(least[islands.bodies()[i]], first);
                EXPECT_EQ(islands.index_in_island(islands.bodies()[i]), i - island.first_body);
            }
            for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
                const BodyPair& p = pairs[islands.pairs()[i]];
                EXPECT_EQ(least[p.row_a < kFree ? p.row_a : p.row_b], first);
            }
        }
    }
}

/// Ties from `first_seed` on make islands of their own; the others only hold what touches together.
TEST(ContactIslands, TiesHoldWhatTouchesTogether) {
    for (std::uint32_t seed = 1; seed <= 30; ++seed) {
        Random random(seed);
        std::vector<BodyPair> pairs, ties;
        for (std::uint32_t i = 0; i < 2 * seed; ++i) {
            const auto a = static_cast<std::int32_t>(random.below(kFree + 5));
            const auto b = static_cast<std::int32_t>(random.below(kFree + 5));
            if (a != b) (i % 3 == 0 ? ties : pairs).push_back({a, b, i, 1});
        }
        const std::size_t first_seed = seed % 2 == 0 ? ties.size() : ties.size() / 2;
        std::vector<BodyPair> all = pairs;
        all.insert(all.end(), ties.begin(), ties.end());
        const std::vector<std::int32_t> least = least_rows(all);
        std::map<std::int32_t, std::size_t> begun, of_ties;
        const auto begin = [&](const BodyPair& p) {
            for (const std::int32_t row : {p.row_a, p.row_b})
                if (row < kFree) begun[least[row]] = 1;
        };
        for (const BodyPair& p : pairs) begin(p);
        for (std::size_t i = first_seed; i < ties.size(); ++i) begin(ties[i]);
        for (const BodyPair& p : ties) {
            const std::int32_t row = p.row_a < kFree ? p.row_a : p.row_b;
            if (row < kFree && begun.count(least[row])) ++of_ties[least[row]];
        }
        ContactIslands islands;
        islands.find(pairs, ties, first_seed, kFree);
        ASSERT_EQ(islands.islands().size(), begun.size()) << "what touches nothing is no island";
        for (const ContactIsland& island : islands.islands()) {
            const std::int32_t first = islands.bodies()[island.first_body];
            EXPECT_EQ(island.last_body - island.first_body,
                      std::count(least.begin(), least.end(), first));
            EXPECT_EQ(island.last_tie - island.first_tie, of_ties[first]);
            for (std::uint32_t i = island.first_tie; i < island.last_tie; ++i) {
                const BodyPair& p = ties[islands.ties()[i]];
                EXPECT_EQ(least[p.row_a < kFree ? p.row_a : p.row_b], first);
            }
        }
    }
}

/// What was asked for before leaves nothing behind, whatever of it changes.
TEST(ContactIslands, AreTheSameWhateverWasAskedForBefore) {
    const std::vector<BodyPair> chain{{0, 1, 0, 1}, {1, 2, 1, 1}, {4, 5, 2, 1}},
        shorter{{0, 1, 0, 1}, {4, 5, 1, 1}}, moved{{0, 3, 0, 1}, {1, 2, 1, 1}, {4, 5, 2, 1}},
        tie{{2, 4, 0, 1}};
    const auto places = [](const ContactIslands& found) {
        return std::tuple(found.island_of(), found.bodies(), found.pairs(), found.ties());
    };
    ContactIslands used;
    const auto expect_as_fresh = [&](const std::vector<BodyPair>& pairs,
                                     const std::vector<BodyPair>& ties, std::size_t first_seed,
                                     std::int32_t dynamic_count) {
        ContactIslands fresh;
        fresh.find(pairs, ties, first_seed, dynamic_count);
        for (int time = 0; time < 2; ++time) {
            used.find(pairs, ties, first_seed, dynamic_count);
            EXPECT_EQ(places(used), places(fresh));
        }
    };
    expect_as_fresh(chain, {}, 0, 6);
    expect_as_fresh(moved, {}, 0, 6);
    expect_as_fresh(shorter, {}, 0, 6);
    expect_as_fresh(shorter, tie, 1, 6);
    expect_as_fresh(shorter, tie, 0, 6);
    expect_as_fresh(shorter, tie, 0, 5);
    expect_as_fresh({}, {}, 0, 0);
    expect_as_fresh(chain, {}, 0, 6);
}

}  // namespace
}  // namespace plumb
