// SPDX-License-Identifier: MIT
/// The substep that begins, as forces see it.
#pragma once

#include "constraints/spring.h"
#include "world/world.h"

namespace plumb {

/// Length of a substep [s].
inline double substep_of(const Settings& settings) { return settings.dt / settings.substeps; }

/// Of a substep of length h [s].
inline SubstepTime substep_time(const World& world, double h) {
    return {h, world.settings.leapfrog_start && world.time == 0 ? 0.5 : 1, world.time};
}

}  // namespace plumb
