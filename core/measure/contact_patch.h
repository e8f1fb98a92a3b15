// SPDX-License-Identifier: MIT
/// What the contacts of one pair of bodies say as a whole: how deep, which way, and over what.
#pragma once

#include <plumb/contact_set.h>

#include "math/types.h"

#include <span>

namespace plumb {

/// The contacts of one pair of bodies, of one collider.
using PairContacts = std::span<const Contact>;

/// The contact of least gap; `contacts` is not empty.
const Contact& deepest(PairContacts contacts);

/// Unit mean of the normals of the contacts that overlap (of all, where none does), each weighed by
/// its depth; the deepest one's normal where they cancel.
Vector3d mean_normal(PairContacts contacts);

/// What the contacts around the deepest span: their area across its normal, and the distance of
/// the two farthest apart.
struct PatchExtent {
    double area = 0;  ///< of the convex outline [m²]
    double span = 0;  ///< [m]
};

/// Of those contacts that share the deepest one's normal (within 2°) and whose gap is at most
/// `highest` [m].
PatchExtent patch_extent(PairContacts contacts, double highest);

/// How far the footprints of two sets reach beyond each other: the greatest difference of their
/// supports along 13 axes, both ways [m].
double footprint_distance(PairContacts first, PairContacts second);

}  // namespace plumb
