// SPDX-License-Identifier: MIT
/// What near pairs of unit size took, as `bench_costs` prints it.
#pragma once

#include "manifold/plugin_table.h"

namespace plumb::reference {

inline constexpr Costs kCosts{{
    // clang-format off
    // plane, sphere, box, capsule, cylinder, cone, hull, mesh, height_field
    {0, 60, 130, 74, 0, 0, 0, 0, 0},
    {60, 110, 110, 130, 0, 0, 0, 0, 0},
    {130, 110, 800, 720, 0, 0, 0, 0, 0},
    {74, 130, 720, 160, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, 0, 0}
    // clang-format on
}};

}  // namespace plumb::reference
