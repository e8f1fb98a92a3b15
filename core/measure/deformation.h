// SPDX-License-Identifier: MIT
/// How far what is made of particles is deformed.
#pragma once

#include "world/world.h"

#include <vector>

namespace plumb {

/// Centre of mass [m].
Vector3d centre_of(const World& world, const Deformable& d);

/// Strain of each deformable, [deformable]: the root of the mean square of its elements' edges'
/// elongations, |e| over that at rest less 1. It does not depend on how finely a shape is divided.
std::vector<double> strains(const World& world);

/// Volume inside of a surface [m³].
double volume_inside(const World& world, const Deformable& d);

/// How much too large each balloon is that keeps a volume, V / k V₀ − 1.
std::vector<double> volume_errors(const World& world);

}  // namespace plumb
