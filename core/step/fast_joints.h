// SPDX-License-Identifier: MIT
/// Joints of trees whose bodies turn too far in a substep.
///
/// Such a body turns as a free one does (math/free_rotation.h), and not as its joint was solved
/// for. Where that opens the joint, its tree was not solved, whatever Newton's steps came to.
#pragma once

#include "effects/plan.h"
#include "effects/report.h"
#include "world/world.h"

#include <vector>

namespace plumb {

class FastJoints {
public:
    FastJoints(const World& world, const Plan& plan);

    /// After the move of a substep of h [s]: adds trees that are open by more than the tolerance.
    void note_open(const World& world, double h, StepReport& report) const;

private:
    struct Item {
        std::uint32_t joint, first;  ///< of its tree
    };
    std::vector<Item> joints_;
};

}  // namespace plumb
