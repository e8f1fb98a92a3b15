// SPDX-License-Identifier: MIT
#include "schedule/joint_forest.h"

#include <algorithm>

namespace plumb {
namespace {

constexpr std::uint32_t kUnknown = ~0u;

/// Bodies by the joints that they have: a list of neighbours in one array.
struct Neighbours {
    std::vector<std::uint32_t> first;  // [body], and one more
    std::vector<std::int32_t> body;
};

Neighbours find_neighbours(const std::vector<BodyPair>& joints, std::int32_t bodies) {
    Neighbours n;
    n.first.assign(static_cast<std::size_t>(bodies) + 1, 0);
    const auto both = [&](auto visit) {
        for (const BodyPair& j : joints)
            if (j.row_a < bodies && j.row_b < bodies)
                visit(j.row_a, j.row_b), visit(j.row_b, j.row_a);
    };
    both([&](std::int32_t from, std::int32_t) { ++n.first[from + 1]; });
    for (std::int32_t i = 0; i < bodies; ++i) n.first[i + 1] += n.first[i];
    n.body.resize(n.first.back());
    std::vector<std::uint32_t> next(n.first.begin(), n.first.end() - 1);
    both([&](std::int32_t from, std::int32_t to) { n.body[next[from]++] = to; });
    return n;
}

}  // namespace

void find_joint_levels(std::vector<BodyPair>& joints, std::int32_t dynamic_count) {
    const Neighbours neighbours = find_neighbours(joints, dynamic_count);
    std::vector<std::uint32_t> depth(static_cast<std::size_t>(dynamic_count), kUnknown);
    std::vector<std::int32_t> queue;
    const auto reach = [&](std::int32_t body, std::uint32_t d) {
        if (body >= dynamic_count || depth[body] != kUnknown) return;
        depth[body] = d;
        queue.push_back(body);
    };
    std::size_t at = 0;
    const auto spread = [&] {
        for (; at < queue.size(); ++at)
            for (std::uint32_t k = neighbours.first[queue[at]]; k < neighbours.first[queue[at] + 1];
                 ++k)
                reach(neighbours.body[k], depth[queue[at]] + 1);
    };
    for (const BodyPair& j : joints)
        if (j.row_a >= dynamic_count || j.row_b >= dynamic_count)
            reach(std::min(j.row_a, j.row_b), 1);
    spread();
    for (const BodyPair& j : joints) {
        reach(std::min(j.row_a, j.row_b), 1);
        spread();
    }
    const auto depth_of = [&](std::int32_t row) { return row < dynamic_count ? depth[row] : 0u; };
    for (BodyPair& j : joints) j.level = std::min(depth_of(j.row_a), depth_of(j.row_b));
}

JointForest grow_joint_forest(const std::vector<BodyPair>& joints, std::int32_t dynamic_count) {
    const auto bodies = static_cast<std::size_t>(dynamic_count);
    std::vector<std::vector<std::uint32_t>> joints_of(bodies);
    std::vector<std::uint32_t> held;
    for (std::uint32_t j = 0; j < joints.size(); ++j) {
        const BodyPair& pair = joints[j];
        if (pair.count == 0) continue;
        if (pair.row_a >= dynamic_count || pair.row_b >= dynamic_count) held.push_back(j);
        for (const std::int32_t row : {pair.row_a, pair.row_b})
            if (row < dynamic_count) joints_of[row].push_back(j);
    }
    JointForest forest;
    forest.in_tree.assign(joints.size(), 0);
    std::vector<std::uint8_t> reached(bodies, 0);
    const auto reach = [&](std::int32_t row, std::int32_t parent, std::uint32_t joint) {
        if (reached[row]) return;
        reached[row] = 1;
        forest.nodes.push_back({row, parent, joint});
        if (parent != kFree) forest.in_tree[joint] = 1, ++forest.edges;
    };
    std::size_t at = 0;
    const auto spread = [&] {
        for (; at < forest.nodes.size(); ++at) {
            const std::int32_t row = forest.nodes[at].row;
            for (const std::uint32_t j : joints_of[row]) {
                const std::int32_t other =
                    joints[j].row_a == row ? joints[j].row_b : joints[j].row_a;
                if (other < dynamic_count) reach(other, static_cast<std::int32_t>(at), j);
            }
        }
    };
    for (const std::uint32_t j : held) reach(std::min(joints[j].row_a, joints[j].row_b), kHeld, j);
    spread();
    for (std::int32_t row = 0; row < dynamic_count; ++row) {
        if (joints_of[row].empty()) continue;
        reach(row, kFree, 0);
        spread();
    }
    for (std::uint32_t j = 0; j < joints.size(); ++j)
        forest.loops += joints[j].count > 0 && !forest.in_tree[j];
    return forest;
}

std::vector<std::uint32_t> depths_of(const JointForest& forest) {
    std::vector<std::uint32_t> depth;
    for (const ForestNode& node : forest.nodes)
        depth.push_back(node.parent < 0 ? 0 : depth[static_cast<std::size_t>(node.parent)] + 1);
    return depth;
}

bool is_narrow(const JointForest& forest) {
    const std::vector<std::uint32_t> depth = depths_of(forest);
    const auto deepest = std::max_element(depth.begin(), depth.end());
    return deepest != depth.end() && 3 * depth.size() < 4 * (std::size_t{*deepest} + 1);
}

std::vector<JointForest> share_out_trees(const JointForest& forest, std::uint32_t parts) {
    const auto is_root = [](const ForestNode& node) { return node.parent < 0; };
    std::vector<std::size_t> size, tree;  // [tree], [node]
    for (const ForestNode& node : forest.nodes) {
        tree.push_back(is_root(node) ? size.size() : tree[node.parent]);
        if (is_root(node)) size.push_back(0);
        ++size[tree.back()];
    }
    std::vector<std::size_t> load(std::min<std::size_t>(parts, size.size()), 0), part_of;
    for (const std::size_t nodes : size) {
        const auto lightest = std::min_element(load.begin(), load.end());
        *lightest += nodes;
        part_of.push_back(static_cast<std::size_t>(lightest - load.begin()));
    }
    std::vector<JointForest> shares(load.size());
    std::vector<std::int32_t> place;  // [node] in its share
    for (std::size_t i = 0; i < forest.nodes.size(); ++i) {
        auto& nodes = shares[part_of[tree[i]]].nodes;
        place.push_back(static_cast<std::int32_t>(nodes.size()));
        ForestNode node = forest.nodes[i];
        if (!is_root(node)) node.parent = place[node.parent];
        nodes.push_back(node);
    }
    return shares;
}

}  // namespace plumb
