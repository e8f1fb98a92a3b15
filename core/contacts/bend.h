// SPDX-License-Identifier: MIT
/// How points of contact move through a substep, beyond what their velocities at its start say.
///
/// Bodies move from one middle of a substep to the next (a leapfrog), straight and at a constant
/// rate of turning: a point of theirs runs along an arc. Contacts that ask for the arc's mean
/// velocity let bodies swing, roll and topple without a loss; those that ask for the velocity at
/// its start overlap by ½ r (ω h)² in every substep, and pushing that out takes energy.
#pragma once

#include "contacts/ground_touch.h"
#include "effects/plan.h"
#include "schedule/workers.h"

namespace plumb {

/// What the coming substep of length h [s] adds to the velocities of points of contact, into
/// ContactTable::bend: of rims whose axis does not swing far, and of points of the material where a
/// contact with what is fixed, or with a kinematic body that turns, carried something in the step
/// before. Of one that only now hits, the turning ends with the impact; and a heap in which bodies
/// hang on bodies comes to rest by what their swings lose. Empties the table where velocities are
/// those of a substep's start, as in the paper (shared_push).
void foresee_bend(World& world, const GroundTouch& ground, const Plan& plan, Workers& workers,
                  double h);

}  // namespace plumb
