// SPDX-License-Identifier: MIT
/// A way to velocities that keep a tree's joints, for where Newton's steps do not find any from v*,
/// what forces and others make of its velocities (trees/tree_solver.h). At rest, joints are as they
/// are; from there the solution is followed while v* grows from rest to all of it, share by share,
/// and then what is closed of old errors (numerical continuation: Allgower and Georg, Introduction
/// to Numerical Continuation Methods, SIAM 2003). Where the way ends, the tree is left with these
/// shares: it is braked, towards the motion of what it hangs by, and no further open than before.
#pragma once

#include "solve/rest_motion.h"
#include "world/world.h"

namespace plumb {

/// Of a tree that hangs by a joint from an immovable body: with that body.
RigidMotion motion_of_holder(const World& world, const Joint& joint);

/// Of a body, while its tree's way is followed.
struct PathNode {
    Velocity<double> goal, rest;  ///< v*, and at rest
    Velocity<double> last;        ///< what was solved for the greatest shares so far
    double deferred[6];           ///< of its joint's errors, where all is closed that may be [m],
                                  ///< [rad]
};

}  // namespace plumb
