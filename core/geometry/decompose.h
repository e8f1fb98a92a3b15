// SPDX-License-Identifier: MIT
/// Closed meshes as a few convex hulls, so that bodies of any form can move.
///
/// The solid is cut by planes. Each time the part whose hull exceeds it by the most volume is cut
/// in two, at that plane of a few candidates which leaves the least excess: planes across the
/// part's principal axes and the world's, and planes of faces at inward edges. The result depends
/// on the mesh alone.
#pragma once

#include "scene/geometry.h"

#include <cstdint>

namespace plumb {

struct DecomposeOptions {
    double excess = 0.05;          ///< volume of the hulls beyond the mesh's, as a share of it
    std::uint32_t max_parts = 32;  ///< no more cuts when there are so many
};

/// Makes a compound of hulls of a closed mesh, and says in it how deep the mesh's surface lies
/// within the hulls. Throws BadShape when the mesh is open, inside out, or cannot be cut.
Geometry decomposed(const Geometry& mesh, const DecomposeOptions& options);

}  // namespace plumb
