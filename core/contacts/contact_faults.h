// SPDX-License-Identifier: MIT
/// What may be wrong with a contact that a collider reports. Such contacts are left out and
/// counted; none reaches the solver.
#pragma once

#include "effects/report.h"
#include "world/world.h"

#include <vector>

namespace plumb {

/// The first fault of a contact. `sweeps`: [body], how far each body was said to move [m].
ContactFault fault_of(const Contact& contact, const World& world,
                      const std::vector<double>& sweeps);

}  // namespace plumb
