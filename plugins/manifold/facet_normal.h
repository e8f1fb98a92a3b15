// SPDX-License-Identifier: MIT
/// Which normals a surface of triangles can have where a body touches one of them.
///
/// A body that lies over an inner edge touches the triangle beside it sideways, as if it could
/// catch there. A smooth or hollow surface has no such contact: only a convex edge, or the border
/// of an open sheet, may push along other directions than its faces do.
#pragma once

#include "manifold/mesh_topology.h"

namespace plumb {

struct FacetNormal {
    Vec3 normal;     ///< unit, out of the surface, shape frame
    bool corrected;  ///< it is not the one that was asked about
};

/// The normal that the surface allows for a touch of facet `f` along the unit vector m, which
/// points from the surface to the body:
///
///  * the face's own normal, and every direction for which what is touched (corner or edge) sticks
///    out farther than all that hangs on it, stay;
///  * beyond the far face of a convex edge, that face's normal;
///  * everything else: the face's own normal.
FacetNormal allowed_normal(const MeshTopology& mesh, const Facet& f, Vec3 m);

}  // namespace plumb
