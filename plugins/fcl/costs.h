// SPDX-License-Identifier: MIT
/// What near pairs of unit size took, as `bench_costs` prints it.
#pragma once

#include "manifold/plugin_table.h"

namespace plumb::by_fcl {

inline constexpr Costs kCosts{{
    // clang-format off
    // plane, sphere, box, capsule, cylinder, cone, hull, mesh, height_field
    {0, 78, 390, 210, 590, 600, 520, 1600, 0},
    {78, 190, 250, 240, 260, 370, 590, 6100, 6200},
    {390, 250, 1200, 670, 8500, 6300, 1900, 31000, 31000},
    {210, 240, 670, 420, 2500, 1600, 840, 4800, 4900},
    {590, 260, 8500, 2500, 13000, 13000, 9100, 61000, 60000},
    {600, 370, 6300, 1600, 13000, 12000, 7700, 46000, 47000},
    {520, 590, 1900, 840, 9100, 7700, 2500, 30000, 30000},
    {1600, 6100, 31000, 4800, 61000, 46000, 30000, 77000, 0},
    {0, 6200, 31000, 4900, 60000, 47000, 30000, 0, 0}
    // clang-format on
}};

}  // namespace plumb::by_fcl
