// SPDX-License-Identifier: MIT
#include "effects/filter_reachability.h"

#include "world/sleep.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

namespace plumb {
namespace {

/// Bodies of one filter.
struct Kind {
    std::uint32_t group, mask;
    bool dynamic;
    std::size_t count;

    bool meets(const Kind& other) const {
        return (group & other.mask) != 0 && (other.group & mask) != 0 &&
               (dynamic || other.dynamic) && (this != &other || count > 1);
    }
};

std::vector<Kind> kinds_of(const Bodies& bodies) {
    std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, std::size_t> counts;
    auto last = counts.end();  // most bodies are of the kind of the one before
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!(bodies.bounding_radius[i] > 0)) continue;
        const std::tuple key(bodies.group[i], bodies.mask[i], is_movable(bodies.motion[i]));
        if (last == counts.end() || last->first != key) last = counts.try_emplace(key, 0).first;
        ++last->second;
    }
    std::vector<Kind> kinds;
    for (const auto& [key, count] : counts)
        kinds.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), count});
    return kinds;
}

}  // namespace

std::size_t collidable_bodies(const World& world) {
    const std::vector<Kind> kinds = kinds_of(world.bodies);
    std::size_t bodies = 0;
    for (const Kind& kind : kinds)
        if (std::any_of(kinds.begin(), kinds.end(),
                        [&](const Kind& other) { return kind.meets(other); }))
            bodies += kind.count;
    return bodies;
}

}  // namespace plumb
