// SPDX-License-Identifier: MIT
/// Which kinds of shape Bullet takes here, in both precisions. Without Bullet itself.
#pragma once

#include "manifold/plugin_table.h"

namespace plumb::bullet {

inline constexpr Supported kSupported{{true, true, true, true, true, true, true, true, true, true},
                                      "bullet does not know this kind of shape"};

}  // namespace plumb::bullet
