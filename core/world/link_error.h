// SPDX-License-Identifier: MIT
/// How far a link's points are from where it holds them.
#pragma once

#include "world/point_place.h"

#include <algorithm>

namespace plumb {

/// By how much they are nearer than its shortest or further apart than its longest [m]; 0 of links
/// that give way (compliance).
inline double link_error(const World& world, const Link& link) {
    if (link.compliance > 0) return 0;
    const double apart = (place_of(world, link.a) - place_of(world, link.b)).norm();
    return std::max({0.0, link.shortest - apart, apart - link.longest});
}

}  // namespace plumb
