// SPDX-License-Identifier: MIT
/// What stands still gives no energy to what touches it: neither do its normal forces, nor its
/// friction. A step may, where a body rolls or rocks too fast for its length, where overlap is
/// pushed out, or where iterations end too early; what is gained so is taken back from the body's
/// motion.
///
/// Velocities belong to the middle between two substeps, positions to their ends: of energy that is
/// kept, the sum of both swings by ½ h F·v about what is put together half a substep back. Neither
/// sum may rise above where the larger stood: what has swung down may come back, and no more.
#pragma once

#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

class StillGround {
public:
    /// Before forces are added: which bodies touch nothing but what is fixed, do not bounce and
    /// hang on no joint; and what they have.
    void note(const World& world, double h);

    /// After the move: takes back what they gained.
    void take_back(World& world, double h) const;

private:
    struct Had {
        std::uint32_t body;
        double energy;  ///< the larger sum, less the potential energy [J]
        Vector3d position;
    };
    std::vector<std::uint8_t> touches_;  ///< [body] Touch
    std::vector<Had> had_;
};

}  // namespace plumb
