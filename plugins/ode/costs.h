// SPDX-License-Identifier: MIT
/// What near pairs of unit size took, as `bench_costs` prints it.
#pragma once

#include "manifold/plugin_table.h"

namespace plumb::ode {

inline constexpr Costs kCosts{{
    // clang-format off
    // plane, sphere, box, capsule, cylinder, cone, hull, mesh, height_field
    {0, 92, 380, 220, 580, 0, 510, 1600, 0},
    {92, 230, 250, 250, 240, 0, 1900, 3700, 3700},
    {380, 250, 930, 420, 4100, 0, 2300, 27000, 26000},
    {220, 250, 420, 360, 3400, 0, 2100, 5100, 5000},
    {580, 240, 4100, 3400, 6900, 0, 7700, 81000, 78000},
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {510, 1900, 2300, 2100, 7700, 0, 2600, 26000, 25000},
    {1600, 3700, 27000, 5100, 81000, 0, 26000, 110000, 0},
    {0, 3700, 26000, 5000, 78000, 0, 25000, 0, 0}
    // clang-format on
}};

}  // namespace plumb::ode
