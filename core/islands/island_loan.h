// SPDX-License-Identifier: MIT
/// Sees to it that an island that is solved exactly, and holds joints, gains no more energy than it
/// may (solve/energy_loan.h): Newton's restitution with friction asks for more where friction turns
/// slip about, ties that stay open are closed by sweeps, and bodies that turn far within a substep
/// leave the way that their rows tell.
#pragma once

#include "islands/exact_island.h"
#include "islands/island_columns.h"
#include "world/world.h"

namespace plumb {

/// After its solution: brakes it, or keeps such a share of what was changed, that it gains no more.
void bound_gain(const World& world, IslandColumns& columns, ExactIsland& island);

/// What it owes now, into the world's joints.
void store_loan(const IslandColumns& columns, const ExactIsland& island, World& world);

}  // namespace plumb
