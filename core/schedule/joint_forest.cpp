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

}  // namespace plumb
