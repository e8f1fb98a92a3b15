// SPDX-License-Identifier: MIT
/// What near pairs of unit size took, as `bench_costs` prints it.
#pragma once

#include "manifold/plugin_table.h"

namespace plumb::ode {

inline constexpr Costs kCosts{{
    // clang-format off
    // plane, sphere, box, capsule, cylinder, cone, hull, mesh, height_field
    {0, 94, 400, 230, 600, 0, 520, 1600, 0},
    {94, 230, 260, 250, 250, 0, 2000, 3700, 3700},
    {400, 260, 950, 430, 4100, 0, 2300, 27000, 26000},
    {230, 250, 430, 380, 3500, 0, 2100, 5100, 5000},
    {600, 250, 4100, 3500, 6900, 0, 7800, 81000, 78000},
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {520, 2000, 2300, 2100, 7800, 0, 2600, 26000, 25000},
    {1600, 3700, 27000, 5100, 81000, 0, 26000, 11000, 0},
    {0, 3700, 26000, 5000, 78000, 0, 25000, 0, 0}
    // clang-format on
}};

}  // namespace plumb::ode
