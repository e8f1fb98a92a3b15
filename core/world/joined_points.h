// SPDX-License-Identifier: MIT
/// Which particles are attached to which bodies: they do not touch these.
#pragma once

#include "world/world.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace plumb {

class JoinedPoints {
public:
    /// Once a step, for bodies come and go.
    void find(const World& world) {
        pairs_.clear();
        for (const Link& link : world.links) {
            if (!link.joins) continue;
            if (link.a.particle != kNoIndex && link.b.body != kNoIndex)
                pairs_.emplace_back(link.a.particle, link.b.body);
            if (link.b.particle != kNoIndex && link.a.body != kNoIndex)
                pairs_.emplace_back(link.b.particle, link.a.body);
        }
        std::sort(pairs_.begin(), pairs_.end());
    }

    bool has(std::uint32_t particle, std::uint32_t body) const {
        return !pairs_.empty() &&
               std::binary_search(pairs_.begin(), pairs_.end(), std::pair(particle, body));
    }

private:
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

}  // namespace plumb
