// SPDX-License-Identifier: MIT
/// What near pairs of unit size took, as `bench_costs` prints it.
#pragma once

#include "manifold/plugin_table.h"

namespace plumb::bullet {

inline constexpr Costs kCosts{{
    // clang-format off
    // plane, sphere, box, capsule, cylinder, cone, hull, mesh, height_field
    {0, 74, 380, 210, 570, 580, 500, 1600, 0},
    {74, 310, 490, 530, 890, 600, 660, 8000, 8500},
    {380, 490, 920, 990, 6300, 4900, 2900, 48000, 48000},
    {210, 530, 990, 800, 2600, 1900, 1100, 8100, 8000},
    {570, 890, 6300, 2600, 8700, 8200, 6600, 58000, 57000},
    {580, 600, 4900, 1900, 8200, 7700, 5700, 53000, 53000},
    {500, 660, 2900, 1100, 6600, 5700, 3400, 47000, 46000},
    {1600, 8000, 48000, 8100, 58000, 53000, 47000, 110000, 0},
    {0, 8500, 48000, 8000, 57000, 53000, 46000, 0, 0}
    // clang-format on
}};

}  // namespace plumb::bullet
