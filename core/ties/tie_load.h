// SPDX-License-Identifier: MIT
/// How far a tie turns within a substep, and how hard it pulls: whether levers of the start of a
/// substep will do until its end.
#pragma once

#include "world/world.h"

namespace plumb {

struct TieLoad {
    double turn = 0;  ///< [rad]
    double pull = 0;  ///< the square of h ω of what it pulls
};

/// By the impulses of the substep before, in one of h [s].
TieLoad load_of(const World& world, const Joint& joint, double h);
TieLoad load_of(const World& world, const Link& link, double h);

}  // namespace plumb
