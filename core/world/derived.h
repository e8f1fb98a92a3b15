// SPDX-License-Identifier: MIT
/// What follows from the tables and from the materials, and is made anew when they change.
#pragma once

#include "world/world.h"

namespace plumb {

/// Dynamic bodies take the first rows of the velocity table, kinematic ones the next; all that is
/// fixed shares the last.
void assign_rows(World& world);

/// How each two of the scene's materials meet, by its rules of combination and its pairs.
void combine_surfaces(World& world, const Scene& scene);

}  // namespace plumb
