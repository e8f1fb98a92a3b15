// SPDX-License-Identifier: MIT
/// Contacts on the rim of a flat round end.
///
/// Such a contact is no point of the material: it is wherever the rim is deepest, and runs around
/// the rim as the body rolls. A point of the material in its stead rises by ½ r (ω h)² while the
/// body is held up by it, and friction that remembers it holds on to what has long been lifted.
#pragma once

#include "world/world.h"

namespace plumb {

/// The rims on which the contacts lie at the poses now, into ContactTable::rims.
void find_rims(World& world);

/// Empties that table: where contacts run on no rims.
void forget_rims(World& world);

/// The point of a rim that is farthest along the unit vector `direction`, both in the body's frame;
/// `otherwise` where the rim's plane is across it.
Vector3d farthest_on(const Rim& rim, const Vector3d& direction, const Vector3d& otherwise);

/// What the coming substep of length h [s] adds to the velocity of a contact that is on a rim, a's
/// less b's [m/s].
Vector3d bend_at_rim(const World& world, std::size_t contact, double h);

/// Where a rim of a pair rolls on along a face, its deepest point alone bears in the coming
/// substep: others that roll into its place would touch as early, and bear with arms of where they
/// are now.
void leave_to_rolling(World& world, const ContactPair& pair, double h);

/// Moves the points of contacts on rims to where the rims are deepest now.
void follow_rims(World& world);

}  // namespace plumb
