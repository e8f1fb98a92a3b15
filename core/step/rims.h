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

/// The point of a rim that is farthest along `direction`, both in the body's frame; `otherwise`
/// where the rim's plane is across it.
Vector3d farthest_on(const Rim& rim, const Vector3d& direction, const Vector3d& otherwise);

/// Moves the points of contacts on rims to where the rims are deepest now.
void follow_rims(World& world);

}  // namespace plumb
