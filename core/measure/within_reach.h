// SPDX-License-Identifier: MIT
/// Tells a state that has run off from one that can still be used.
#pragma once

#include "world/world.h"

namespace plumb {

/// Whether all bodies and particles are where a recording, in single precision, can still tell.
bool within_reach(const World& world);

}  // namespace plumb
