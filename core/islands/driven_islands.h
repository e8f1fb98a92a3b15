// SPDX-License-Identifier: MIT
/// Which islands are moved by others: a kinematic body (a press, a conveyor) touches or pulls them,
/// or a motor that nothing can stop.
#pragma once

#include "schedule/contact_islands.h"
#include "world/tie.h"

#include <cstdint>
#include <vector>

namespace plumb {

class DrivenIslands {
public:
    /// Once a step: among those that `pairs` and `ties` make.
    void find(const World& world, const std::vector<BodyPair>& pairs, const std::vector<Tie>& ties,
              const ContactIslands& found);

    /// Whether the island of a body is. `row`: of the body, dynamic.
    bool is_driven(std::int32_t row) const { return driven_[static_cast<std::size_t>(row)] != 0; }

private:
    std::vector<std::uint8_t> driven_;      // [dynamic row]
    std::vector<std::uint32_t> boundless_;  // joints whose motors nothing can stop
};

}  // namespace plumb
