// SPDX-License-Identifier: MIT
/// How far the end of a step is from its constraints.
///
/// The residual of a constraint is what one more exact solution of it alone would change: of its
/// impulse, over the length of the substep a force [N], and of its velocity, times that length a
/// length [m]. Of a contact it is the vector of its normal and its friction impulse, both passes
/// together, projected on what a contact can bear: it repels, no more than closes the gap, within
/// Coulomb's cone. It is 0 where the laws hold, and tells of the last substep.
#pragma once

#include <cstdint>

namespace plumb {

/// Of an island: bodies that touch or are joined, directly or through others that can move.
struct IslandResidual {
    std::uint32_t first_body = ~0u;  ///< the least index of its bodies
    std::uint32_t bodies = 0;
    bool exact = false;    ///< nothing of it was iterated
    double weight = 0;     ///< of its bodies; without gravity, the sum of its normal forces [N]
    double force = 0;      ///< of its worst constraint [N]
    double rms_force = 0;  ///< root mean square over its constraints [N]
    double error = 0;      ///< of its worst constraint [m]

    /// 0 where there is nothing to compare with.
    double force_of_weight() const { return weight > 0 ? force / weight : 0; }
};

/// Of all islands of a step.
struct StepResidual {
    std::uint32_t islands = 0;
    double force = 0;      ///< of the worst constraint [N]
    double error = 0;      ///< the same [m], of the same or another one
    IslandResidual worst;  ///< the island with the greatest force against its weight
};

}  // namespace plumb
