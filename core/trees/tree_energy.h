// SPDX-License-Identifier: MIT
/// What a part of a substep makes of the energy of a tree (step/divided_trees.h). A holder that is
/// moved does work on what hangs by it: energies are those that one sees who moves along with the
/// point by which the tree hangs, where its force does none, and a torque does what it turns by.
#pragma once

#include "constraints/substep_time.h"
#include "world/world.h"

#include <vector>

namespace plumb {

/// The point by which a tree hangs, in one part of a substep.
struct TreeHold {
    Vector3d point = Vector3d::Zero();         ///< at the start of the part [m]
    Vector3d velocity = Vector3d::Zero();      ///< mean of this part's and of the one before [m/s]
    Vector3d rate = Vector3d::Zero();          ///< likewise, of the holder [rad/s]
    Vector3d acceleration = Vector3d::Zero();  ///< from the one to the other [m/s²]
};

/// The work of the torque by which its holder turns a tree [J]. `pushed`: velocities with forces
/// alone, in the order of the bodies [m/s].
double turning_work(const World& world, const std::vector<std::uint32_t>& bodies,
                    const std::vector<Vector3d>& pushed, const TreeHold& hold);

/// What a part gained, or, less than 0, lost that no force accounts for, against what moves [J/J];
/// `fall`: for how
/// long gravity pushed [s]; `unclosed`: by how much joints may be open, whose pull does work on
/// that [m]; `work`: of the holder [J]. Velocities are those of the middles of parts of one length.
double energy_defect(const World& world, const std::vector<std::uint32_t>& bodies,
                     const SubstepTime& time, double fall, double unclosed, const TreeHold& hold,
                     double work);

}  // namespace plumb
