// SPDX-License-Identifier: MIT
/// Nearest or deepest contact of two parts at any distance.
///
/// Half-spaces and balls are answered in closed form; convex parts that are apart by their closest
/// points; meshes and height fields triangle by triangle, as far as their tree says that a nearer
/// one may come. Parts whose surfaces meet are left to the plugin's narrow phase.
#pragma once

#include "manifold/ball_contact.h"

namespace plumb {

enum class Closeness {
    found,   ///< the contact is filled in
    meet,    ///< the surfaces meet: ask the narrow phase for the deepest contact
    nothing  ///< two half-spaces
};

/// Fills in all of the contact, a before b. What lies inside of a closed mesh without touching it
/// gets the local way out, and is marked approximate.
Closeness closest_of_parts(Contact& contact, const Part& a, const Part& b);

/// The same for convex parts that meet, of which the narrow phase found nothing: closest points of
/// the parts made a little smaller. False where that has no answer either.
bool closest_of_smaller(Contact& contact, const Part& a, const Part& b);

}  // namespace plumb
