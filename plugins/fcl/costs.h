// SPDX-License-Identifier: MIT
/// What near pairs of unit size took, as `bench_costs` prints it.
#pragma once

#include "manifold/plugin_table.h"

namespace plumb::by_fcl {

inline constexpr Costs kCosts{{
    // clang-format off
    // plane, sphere, box, capsule, cylinder, cone, hull, mesh, height_field
    {0, 75, 360, 210, 580, 580, 490, 1600, 0},
    {75, 180, 240, 230, 250, 360, 570, 6000, 6100},
    {360, 240, 1200, 670, 8500, 6100, 1900, 31000, 31000},
    {210, 230, 670, 410, 2500, 1600, 810, 4800, 4900},
    {580, 250, 8500, 2500, 13000, 13000, 8900, 61000, 60000},
    {580, 360, 6100, 1600, 13000, 12000, 7700, 46000, 47000},
    {490, 570, 1900, 810, 8900, 7700, 2500, 30000, 30000},
    {1600, 6000, 31000, 4800, 61000, 46000, 30000, 110000, 0},
    {0, 6100, 31000, 4900, 60000, 47000, 30000, 0, 0}
    // clang-format on
}};

}  // namespace plumb::by_fcl
