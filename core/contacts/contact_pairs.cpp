// SPDX-License-Identifier: MIT
#include "contacts/contact_pairs.h"

#include <algorithm>

namespace plumb {

void find_pairs(const World& world, const std::vector<std::uint32_t>* levels,
                std::vector<BodyPair>& pairs) {
    pairs.clear();
    for (const ContactPair& p : world.contacts.pairs)
        pairs.push_back({world.bodies.row[p.a], world.bodies.row[p.b], p.first, p.count,
                         levels ? std::max((*levels)[p.a], (*levels)[p.b]) : 0});
}

void find_levels(const World& world, std::vector<std::uint32_t>& levels) {
    const Bodies& bodies = world.bodies;
    const auto n = static_cast<std::uint32_t>(bodies.size());
    levels.assign(n, n);
    for (std::uint32_t i = 0; i < n; ++i)
        if (bodies.motion[i] != Motion::dynamic) levels[i] = 0;

    // contacts relax the levels until none falls: few rounds, since a round runs forwards and
    // backwards
    const std::vector<ContactPair>& pairs = world.contacts.pairs;
    auto relax = [&](const ContactPair& c) {
        const std::uint32_t via = std::min(levels[c.a], levels[c.b]) + 1;
        const bool falls = via < levels[c.a] || via < levels[c.b];
        levels[c.a] = std::min(levels[c.a], via);
        levels[c.b] = std::min(levels[c.b], via);
        return falls;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (const ContactPair& c : pairs) changed |= relax(c);
        for (auto c = pairs.rbegin(); c != pairs.rend(); ++c) changed |= relax(*c);
    }
    std::uint32_t highest = 0;
    for (std::uint32_t level : levels)
        if (level < n) highest = std::max(highest, level);
    for (std::uint32_t& level : levels) level = std::min(level, highest + 1);
}

}  // namespace plumb
