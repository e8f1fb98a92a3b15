// SPDX-License-Identifier: MIT
/// Memory of the ball joints' solver: W joints side by side.
#pragma once

#include "schedule/contact_rows.h"

namespace plumb {

template <class Real, int W>
struct alignas(64) BallBlock {
    Real inverse_mass_a[W], inverse_mass_b[W];              // [1/kg]
    Real inverse_inertia_a[6][W], inverse_inertia_b[6][W];  // xx yy zz xy xz yz, world frame
    std::int32_t row_a[W], row_b[W];                        // row of the body in the velocity table
    Real arm_a[3][W], arm_b[3][W];                          // at the start of the substep [m]
    Real gap[3][W];  // a − b at the start of the substep [m]
    Real used[W];    // 1 where a joint sits, 0 in an empty lane
};

}  // namespace plumb
