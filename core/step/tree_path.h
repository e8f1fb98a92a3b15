// SPDX-License-Identifier: MIT
/// A way to velocities that keep a tree's joints, for where Newton's steps do not find any from v*,
/// what forces and others make of its velocities (step/tree_solver.h). At rest, joints are as they
/// are; from there the solution is followed while v*, and what is closed of old errors, grow from
/// rest to all of it, share by share (numerical continuation: Allgower and Georg, Introduction to
/// Numerical Continuation Methods, SIAM 2003). Where the way ends, the tree is left with that
/// share: it is braked, and no further open than before.
#pragma once

#include "step/rest_motion.h"
#include "world/world.h"

namespace plumb {

/// Of a tree that hangs by a joint from an immovable body: with that body.
RestMotion motion_of_holder(const World& world, const Joint& joint);

/// Of a body, while its tree's way is followed.
struct PathNode {
    Velocity<double> goal, rest;  ///< v*, and at rest
    Velocity<double> last;        ///< what was solved for the greatest share so far
    double deferred[6];           ///< of its joint's errors, with the whole share [m], [rad]
};

}  // namespace plumb
