// SPDX-License-Identifier: MIT
#include "schedule/joint_forest.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace plumb {
namespace {

using test::Random;
constexpr std::int32_t kDynamic = 60;

std::vector<BodyPair> random_joints(std::uint32_t count) {
    Random random(count);
    std::vector<BodyPair> joints;
    for (std::uint32_t i = 0; i < count; ++i) {
        // rows from 60 on are immovable
        const auto a = static_cast<std::int32_t>(random.below(64));
        auto b = static_cast<std::int32_t>(random.below(kDynamic));
        if (a == b) b = (b + 1) % kDynamic;
        joints.push_back({a, b, i, random.below(4)});
    }
    return joints;
}

/// Sets of bodies that edges link, immovable ones being one, as a count of merges.
std::uint32_t spanning_edges(const std::vector<BodyPair>& joints) {
    std::vector<std::int32_t> set(kDynamic + 1);
    std::iota(set.begin(), set.end(), 0);
    const auto root = [&](std::int32_t i) {
        for (i = std::min(i, kDynamic); set[i] != i;) i = set[i];
        return i;
    };
    std::uint32_t merges = 0;
    for (const BodyPair& j : joints) {
        const std::int32_t a = root(j.row_a), b = root(j.row_b);
        if (j.count == 0 || a == b) continue;
        set[a] = b;
        ++merges;
    }
    return merges;
}

TEST(JointForest, TakesEveryJointThatClosesNoLoop) {
    for (std::uint32_t count : {0u, 5u, 30u, 60u, 200u}) {
        const std::vector<BodyPair> joints = random_joints(count);
        const JointForest forest = grow_joint_forest(joints, kDynamic);
        EXPECT_EQ(forest.edges, spanning_edges(joints)) << count;
        std::uint32_t rows = 0, edges = 0;
        for (std::uint32_t j = 0; j < count; ++j) {
            rows += joints[j].count > 0;
            edges += forest.in_tree[j];
        }
        EXPECT_EQ(edges, forest.edges);
        EXPECT_EQ(rows, forest.edges + forest.loops);
    }
}

TEST(JointForest, ListsParentsBeforeTheirChildren) {
    const std::vector<BodyPair> joints = random_joints(80);
    const JointForest forest = grow_joint_forest(joints, kDynamic);
    std::set<std::int32_t> rows;
    for (std::size_t i = 0; i < forest.nodes.size(); ++i) {
        const ForestNode& node = forest.nodes[i];
        EXPECT_TRUE(rows.insert(node.row).second) << "a body is one node";
        if (node.parent == kFree) continue;
        const BodyPair& joint = joints[node.joint];
        EXPECT_TRUE(forest.in_tree[node.joint]);
        const std::int32_t other = joint.row_a == node.row ? joint.row_b : joint.row_a;
        EXPECT_TRUE(joint.row_a == node.row || joint.row_b == node.row);
        if (node.parent == kHeld) {
            EXPECT_GE(other, kDynamic);
            continue;
        }
        ASSERT_LT(static_cast<std::size_t>(node.parent), i);
        EXPECT_EQ(forest.nodes[static_cast<std::size_t>(node.parent)].row, other);
    }
}

}  // namespace
}  // namespace plumb
