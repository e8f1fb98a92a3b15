// SPDX-License-Identifier: MIT
/// The bodies by how they move, each in one list.
#pragma once

#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

struct MotionLists {
    std::vector<std::uint32_t> plain;       ///< dynamic, without a momentum that is carried
    std::vector<std::uint32_t> gyroscopic;  ///< dynamic, with the term that conserves
    std::vector<std::uint32_t> scripted;    ///< kinematic
};

/// Whether bodies of unequal moments carry their angular momentum. `gyroscopic`: whether the plan
/// runs that effect.
inline bool carry_momentum(const Settings& settings, bool gyroscopic) {
    return gyroscopic && settings.gyroscopic == Gyroscopic::conserving;
}

/// `gyroscopic`: as above.
inline MotionLists sort_by_motion(const World& world, bool gyroscopic) {
    const Bodies& b = world.bodies;
    const bool conserving = carry_momentum(world.settings, gyroscopic);
    MotionLists lists;
    for (std::uint32_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] == Motion::kinematic) lists.scripted.push_back(i);
        if (b.motion[i] != Motion::dynamic) continue;
        (conserving && !b.isotropic[i] ? lists.gyroscopic : lists.plain).push_back(i);
    }
    return lists;
}

}  // namespace plumb
