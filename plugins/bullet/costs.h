// SPDX-License-Identifier: MIT
/// What near pairs of unit size took, as `bench_costs` prints it.
#pragma once

#include "manifold/plugin_table.h"

namespace plumb::bullet {

inline constexpr Costs kCosts{{
    // clang-format off
    // plane, sphere, box, capsule, cylinder, cone, hull, mesh, height_field
    {0, 78, 390, 210, 600, 600, 500, 1600, 0},
    {78, 320, 510, 550, 940, 620, 680, 8100, 8500},
    {390, 510, 940, 1000, 6300, 4900, 2900, 48000, 48000},
    {210, 550, 1000, 800, 2700, 1900, 1100, 8100, 8000},
    {600, 940, 6300, 2700, 8900, 8200, 6700, 58000, 57000},
    {600, 620, 4900, 1900, 8200, 7700, 5700, 53000, 53000},
    {500, 680, 2900, 1100, 6700, 5700, 3400, 47000, 46000},
    {1600, 8100, 48000, 8100, 58000, 53000, 47000, 16000, 0},
    {0, 8500, 48000, 8000, 57000, 53000, 46000, 0, 0}
    // clang-format on
}};

}  // namespace plumb::bullet
