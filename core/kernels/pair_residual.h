// SPDX-License-Identifier: MIT
/// What kernels tell of residuals (effects/residual.h).
#pragma once

#include "schedule/contact_rows.h"

namespace plumb {

/// What one more solution of each constraint alone, between W pairs of bodies, would change, in
/// squares. That of a contact is the vector of its normal and its friction.
template <class Real, int W>
struct alignas(kRowAlignment<Real, W>) PairResidual {
    Real worst[W], sum[W];  // of impulses, the greatest and all [N² s²]
    Real error[W];          // of velocities, the greatest [m²/s²]
    Real push[W];           // what contacts bear along their normals [N s]
};

}  // namespace plumb
