// SPDX-License-Identifier: MIT
#include "contacts/contact_pairs.h"

#include <algorithm>

namespace plumb {

void find_pairs(const World& world, const std::vector<std::uint32_t>* levels,
                std::vector<BodyPair>& pairs) {
    pairs.clear();
    const std::vector<Contact>& found = world.contacts.found;
    each_pair(found, 0, found.size(), [&](std::size_t first, std::size_t end) {
        const Contact& c = found[first];
        BodyPair pair{world.bodies.row[c.a], world.bodies.row[c.b],
                      static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first),
                      0};
        if (levels) pair.level = std::max((*levels)[c.a], (*levels)[c.b]);
        pairs.push_back(pair);
    });
}

void find_levels(const World& world, std::vector<std::uint32_t>& levels) {
    const Bodies& bodies = world.bodies;
    const auto n = static_cast<std::uint32_t>(bodies.size());
    levels.assign(n, n);
    for (std::uint32_t i = 0; i < n; ++i)
        if (bodies.motion[i] != Motion::dynamic) levels[i] = 0;

    // contacts relax the levels until none falls: few rounds, since a round runs forwards and
    // backwards
    const std::vector<Contact>& found = world.contacts.found;
    auto relax = [&](const Contact& c) {
        const std::uint32_t via = std::min(levels[c.a], levels[c.b]) + 1;
        const bool falls = via < levels[c.a] || via < levels[c.b];
        levels[c.a] = std::min(levels[c.a], via);
        levels[c.b] = std::min(levels[c.b], via);
        return falls;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (const Contact& c : found) changed |= relax(c);
        for (auto c = found.rbegin(); c != found.rend(); ++c) changed |= relax(*c);
    }
    std::uint32_t highest = 0;
    for (std::uint32_t level : levels)
        if (level < n) highest = std::max(highest, level);
    for (std::uint32_t& level : levels) level = std::min(level, highest + 1);
}

}  // namespace plumb
