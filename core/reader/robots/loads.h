// SPDX-License-Identifier: MIT
/// What a robot's motors have to move.
///
/// A motor's frequency is that of the two bodies which its joint ties (scene/joint.h), but a knee
/// carries the trunk and all that hangs on it. So robots count a motor's frequency as that of the
/// heavier of the two sides of its joint, with all other joints stiff, and the other side held.
#pragma once

#include <optional>
#include <vector>

#include "reader/robots/tree.h"

namespace plumb::reader {

/// For each group's joint the factor from the frequency of the heavier side to that of the two
/// bodies alone: √(load · response). 1 where a joint has no coordinate. `masses` has none for what
/// is fixed; groups are placed.
std::vector<double> frequency_factors(const std::vector<LinkGroup>& groups,
                                      const std::vector<std::optional<MovingMass>>& masses);

}  // namespace plumb::reader
