// SPDX-License-Identifier: MIT
/// Contacts of a ball, or of a particle, with any part: the ball's centre and the part's signed
/// distance tell all.
#pragma once

#include "manifold/contact_list.h"
#include "manifold/signed_distance.h"

namespace plumb {

/// Fills in points, radii, normal, gap and flags of a contact between a ball as a and a part as b,
/// of which `nearest` is the surface's point nearest to the ball's centre.
void fill_ball_contact(Contact& contact, Vec3 centre, double radius, const Part& part,
                       const SurfacePoint& nearest);

/// The distance between a ball, as a or b, and a shape of a closed form; the normal points out of
/// b towards a. False where neither part is a ball, or the other is none of these.
bool closed_form_gap(double& gap, Vec3& normal, const Part& a, const Part& b);

/// Makes a the b, and the other way round.
void turn_round(Contact& contact);

}  // namespace plumb
