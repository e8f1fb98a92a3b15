// SPDX-License-Identifier: MIT
#include "schedule/joint_forest.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <map>
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

TEST(JointForest, IsSharedOutByWholeTrees) {
    for (std::uint32_t count : {0u, 5u, 20u, 30u}) {
        const std::vector<BodyPair> joints = random_joints(count);
        const JointForest forest = grow_joint_forest(joints, kDynamic);
        std::map<std::int32_t, ForestNode> whole, shared;  // by row
        for (const ForestNode& node : forest.nodes) whole[node.row] = node;
        const std::vector<JointForest> shares = share_out_trees(forest, 3);
        EXPECT_LE(shares.size(), 3u);
        for (const JointForest& share : shares) {
            EXPECT_FALSE(share.nodes.empty());
            for (std::size_t i = 0; i < share.nodes.size(); ++i) {
                const ForestNode& node = share.nodes[i];
                ASSERT_LT(node.parent, static_cast<std::int32_t>(i));
                EXPECT_TRUE(shared.emplace(node.row, node).second);
                const ForestNode& before = whole.at(node.row);
                EXPECT_EQ(node.joint, before.joint);
                if (before.parent < 0)
                    EXPECT_EQ(node.parent, before.parent);
                else
                    EXPECT_EQ(share.nodes[std::size_t(node.parent)].row,
                              forest.nodes[std::size_t(before.parent)].row);
            }
        }
        EXPECT_EQ(shared.size(), whole.size());
    }
}

TEST(JointForest, SharesTreesOutEvenly) {
    std::vector<BodyPair> joints;  // twenty chains of three bodies
    for (std::int32_t i = 0; i < kDynamic; ++i)
        joints.push_back({i, i % 3 == 0 ? kDynamic : i - 1, std::uint32_t(i), 3});
    const auto shares = share_out_trees(grow_joint_forest(joints, kDynamic), 4);
    ASSERT_EQ(shares.size(), 4u);
    for (const JointForest& share : shares) EXPECT_EQ(share.nodes.size(), 15u);
}

}  // namespace
}  // namespace plumb
