// SPDX-License-Identifier: MIT
#include "schedule/tree_levels.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <set>

namespace plumb {
namespace {

JointForest random_forest(test::Random& random, std::size_t count) {
    JointForest forest;
    for (std::size_t i = 0; i < count; ++i) {
        const auto row = static_cast<std::int32_t>(i);
        const bool root = i == 0 || random.below(12) == 0;
        const std::int32_t parent =
            root ? (random.below(2) == 0 ? kHeld : kFree)
                 : static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(i)));
        forest.nodes.push_back({row, parent, 0});
    }
    return forest;
}

TEST(TreeGroups, LetNoTwoOfAGroupAddToOneParentAndChildrenComeAfterIt) {
    test::Random random(5);
    for (int run = 0; run < 50; ++run) {
        const JointForest forest = random_forest(random, 1 + random.below(200));
        std::vector<std::uint8_t> together;
        for (std::size_t i = 0; i < forest.nodes.size(); ++i) together.push_back(random.below(2));
        std::set<std::uint32_t> seen;
        for (const TreeGroup& group : find_tree_groups(forest, together)) {
            std::set<std::int32_t> parents;
            for (const std::uint32_t node : group.nodes) {
                const std::int32_t parent = forest.nodes[node].parent;
                EXPECT_EQ(group.side_by_side, together[node] != 0);
                if (parent >= 0) {
                    EXPECT_TRUE(parents.insert(parent).second);
                    EXPECT_TRUE(seen.count(static_cast<std::uint32_t>(parent)));
                }
            }
            seen.insert(group.nodes.begin(), group.nodes.end());
        }
        EXPECT_EQ(seen.size(), forest.nodes.size());
    }
}

TEST(TreeGroups, KnowWhoComesFirstFromTheLeavesAndWhoHasNoChildren) {
    test::Random random(6);
    for (int run = 0; run < 50; ++run) {
        const JointForest forest = random_forest(random, 1 + random.below(200));
        std::set<std::int32_t> reached;  // parents that a child was taken to
        const std::vector<TreeGroup> groups =
            find_tree_groups(forest, std::vector<std::uint8_t>(forest.nodes.size(), 1));
        for (auto group = groups.rbegin(); group != groups.rend(); ++group)
            for (const std::uint32_t node : group->nodes) {
                const auto self = static_cast<std::int32_t>(node);
                EXPECT_EQ(group->leaves, reached.count(self) == 0);
                const std::int32_t parent = forest.nodes[node].parent;
                if (parent < 0) continue;
                EXPECT_EQ(group->first, reached.insert(parent).second);
            }
    }
}

}  // namespace
}  // namespace plumb
