// SPDX-License-Identifier: MIT
/// Which bodies touch what stands still and nothing else: what they gain and lose there is known.
#pragma once

#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

class GroundTouch {
public:
    /// By the contacts and by what bounces in the coming substep.
    void find(const World& world);

    /// Whether a body touches nothing but what is fixed or kinematic and at rest, does not bounce,
    /// and hangs on no joint and no deformable.
    bool is_alone(std::uint32_t body) const { return touches_[body] == still_only; }

private:
    enum Touch : std::uint8_t { nothing, still_only, else_too };
    std::vector<Touch> touches_;  ///< [body]
};

}  // namespace plumb
