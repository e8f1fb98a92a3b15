// SPDX-License-Identifier: MIT
/// Inverses of what may be nothing.
#pragma once

#include "math/lanes.h"

namespace plumb::kernels {

/// 1/x, and 0 where x is 0 (both bodies immovable, or an empty lane).
template <class T>
inline T inverse_or_zero(const T& x) {
    return select_greater(x, T(1e-30), T(1) / max(x, T(1e-30)), T(0));
}

}  // namespace plumb::kernels
