// SPDX-License-Identifier: MIT
/// Whether a contact can close within the step at all.
///
/// Contacts are found as far away as bodies may travel, and what spins fast travels far. But it
/// turns within the sphere about its centre of mass that holds it: a point that runs towards
/// another body as fast as its velocity tells does so on an arc. Held against a gap, such a
/// velocity would push bodies that never meet.
#pragma once

#include "world/world.h"

namespace plumb {

/// Whether the bodies of a contact stay on their sides of it within the step, however they turn, by
/// the velocities and forces that they have.
bool is_out_of_reach(const World& world, const Contact& contact);

}  // namespace plumb
