// SPDX-License-Identifier: MIT
#include "host/choose_collider.h"

#include "host/shape_pairs.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <tuple>

namespace plumb {
namespace {

using Needs = std::vector<ShapePairNeed>;

constexpr const char* kYardstick = "reference";

/// A plugin that can do the scene.
struct Candidate {
    const ColliderInfo* info;
    bool known;   ///< costs of all pairs
    double cost;  ///< of one detection [ns]; 0 where not known

    auto rank() const {
        const bool single = std::strcmp(info->table->precision, "single") == 0;
        return std::tuple(info->name == kYardstick, single, !known, cost, info->name);
    }
};

Candidate candidate(const ColliderInfo& info, const Needs& needs) {
    Candidate c{&info, true, 0};
    for (const ShapePairNeed& need : needs) {
        const std::uint32_t cost =
            info.table->costs[static_cast<std::size_t>(need.a)][static_cast<std::size_t>(need.b)];
        c.known = c.known && cost > 0;
        c.cost += need.near * cost;
    }
    if (!c.known) c.cost = 0;
    return c;
}

/// Those that support every pair, best first.
std::vector<Candidate> ranked(const std::vector<ColliderInfo>& colliders, const Needs& needs) {
    std::vector<Candidate> able;
    for (const ColliderInfo& c : colliders)
        if (c.table && std::all_of(needs.begin(), needs.end(),
                                   [&](const ShapePairNeed& n) { return supports(*c.table, n); }))
            able.push_back(candidate(c, needs));
    std::sort(able.begin(), able.end(),
              [](const Candidate& p, const Candidate& q) { return p.rank() < q.rank(); });
    return able;
}

std::string what_it_supports(std::size_t pairs) {
    if (pairs == 0) return "the scene has no pairs of shapes that could touch";
    if (pairs == 1) return "supports the only pair of shapes";
    return "supports all " + std::to_string(pairs) + " pairs of shapes";
}

/// ", about 0.72 of bullet's cost, 0.31 of fcl's", or why there is nothing to compare.
std::string compared(const std::vector<Candidate>& able) {
    const Candidate& best = able.front();
    if (able.size() == 1) return ", as no other does";
    if (!best.known) return "; what it costs is not known";
    std::string words;
    for (const Candidate& c : able) {
        if (&c == &best || !c.known || !(c.cost > 0)) continue;
        char ratio[32];
        std::snprintf(ratio, sizeof ratio, "%.2g of ", best.cost / c.cost);
        words += (words.empty() ? ", about " : ", ") + (ratio + c.info->name) +
                 (words.empty() ? "'s cost" : "'s");
    }
    return words;
}

}  // namespace

ColliderChoice choose_collider(const std::vector<ColliderInfo>& colliders, const Scene& scene) {
    const Needs needs = shape_pair_needs(scene);
    const std::vector<Candidate> able = ranked(colliders, needs);
    if (able.empty()) return {};
    std::string reason = what_it_supports(needs.size());
    if (!needs.empty()) reason += compared(able);
    return {able.front().info, reason};
}

}  // namespace plumb
