// SPDX-License-Identifier: MIT
/// Residuals of joints that form trees (effects/residual.h): exact by themselves, they are left
/// open by what touches their bodies.
#pragma once

#include "solve/island_residuals.h"
#include "world/world.h"

namespace plumb {

/// Of the translations that a joint locks without compliance, from how they are open where bodies
/// are now, at the end of a substep of length h [s].
ResidualSum open_residual(const World& world, const Joint& joint, double h);

}  // namespace plumb
