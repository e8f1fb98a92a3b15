// SPDX-License-Identifier: MIT
/// What is left of a deformable that tears.
#pragma once

#include "world/particles.h"

namespace plumb {

/// Makes the elements of `spec` those of `whole` that are not in `torn`. A balloon with a hole is
/// cloth, and what a tear lays open of a solid is its surface.
void leave_out_torn(Deformable& d);

}  // namespace plumb
