// SPDX-License-Identifier: MIT
/// The substep that begins, as forces see it.
#pragma once

#include "constraints/spring.h"
#include "world/world.h"

namespace plumb {

/// Of a substep of length h [s].
inline SubstepTime substep_time(const World& world, double h) {
    return {h, world.settings.leapfrog_start && world.time == 0 ? 0.5 : 1, world.time};
}

}  // namespace plumb
