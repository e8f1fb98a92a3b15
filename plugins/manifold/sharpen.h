// SPDX-License-Identifier: MIT
/// The normal of a back-end in single precision, or of one that searches round shapes step by step,
/// made exact by the true shapes.
///
/// The support gap along a direction never exceeds the true gap, so of directions near the
/// back-end's normal the one with the greatest support gap is nearest to the truth. Tried are those
/// that a contact of exact shapes can have: the faces' normals, those across an edge of each, those
/// across one edge, and the way between the closest points; for cylinders and cones the way between
/// their axes, and that between the closest points once they are drawn apart.
#pragma once

#include "manifold/manifold.h"

namespace plumb {

/// Whether a sharp shape has more directions than those of its faces and edges.
bool is_bent(const Part& part);

/// Turns the normal of a convex pair by at most about three degrees. Neither part may be a plane.
void sharpen(Witness& witness, const Part& a, const Part& b);

/// The same where a part is bent: the searches of all back-ends end some 10⁻⁴ to 10⁻² beside the
/// normal of a rim, another one at each step, and what rests on it never comes to rest.
inline void sharpen_bent(Witness& witness, const Part& a, const Part& b) {
    if (is_bent(a) || is_bent(b)) sharpen(witness, a, b);
}

}  // namespace plumb
