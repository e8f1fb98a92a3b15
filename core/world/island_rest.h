// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace plumb {

/// For how long a joint or a link is left out of the islands that are solved exactly, since one
/// that held it was not: what contradicts itself is left to sweeps, and tried again ever more
/// seldom.
struct IslandRest {
    std::uint32_t steps = 0;   ///< that are left
    std::uint32_t misses = 0;  ///< without a success between them
};

}  // namespace plumb
