// SPDX-License-Identifier: MIT
/// What stands still gives no energy to what touches it: neither do its normal forces, nor its
/// friction. A step may, where a body rolls or rocks too fast for its length, where overlap is
/// pushed out, or where iterations end too early; what is gained so is taken back from the body's
/// motion.
///
/// Velocities belong to the middle between two substeps, positions to their ends: of energy that is
/// kept, the sum of both swings by ½ h F·v about what is put together half a substep back. The
/// latter may not rise, nor the former by more than a little above it. Where a body swings, its
/// substeps lose and gain by turns: it may regain what it lost in the last seconds, of which
/// impacts do not count, up to a small share of what it has.
#pragma once

#include "contacts/ground_touch.h"

#include <cstdint>
#include <vector>

namespace plumb {

class StillGround {
public:
    /// Before forces are added: what those have that touch nothing but what is fixed.
    void note(const World& world, const GroundTouch& ground, double h);

    /// After the move: takes back what they gained.
    void take_back(World& world, double h) const;

private:
    struct Had {
        std::uint32_t body;
        double energy;  ///< the larger sum, less the potential energy [J]
        Vector3d position;
    };
    std::vector<Had> had_;
};

}  // namespace plumb
