// SPDX-License-Identifier: MIT
/// Solids bounded by triangles, cut in two by planes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace plumb {

/// A triangle of a solid's boundary, counter-clockwise from outside.
struct SolidFacet {
    std::array<Eigen::Vector3d, 3> corners;  ///< [m]
    bool cut;                                ///< made by a cut, not part of the first surface
};

/// Facets that close up; edges may meet others along a part of their length.
using Solid = std::vector<SolidFacet>;

/// Points p with normal · p = offset.
struct Plane {
    Eigen::Vector3d normal;  ///< unit
    double offset;           ///< [m]
};

/// A solid's halves without the faces that the cut opens, which lie in the plane.
struct OpenHalves {
    Solid below, above;
};

/// Cuts a solid; corners within `tolerance` [m] of the plane lie in it.
OpenHalves cut_open(const Solid& solid, const Plane& plane, double tolerance);

/// Closes a half at the plane with facets that face along `side` × normal; side is 1 or −1.
void close_at(Solid& half, const Plane& plane, double side, double tolerance);

/// Volume between the facets [m³]; facets of a plane through `from` may be missing.
double volume_of(const Solid& solid, const Eigen::Vector3d& from);

/// Volume integral of the squared distance from the centre of volume [m⁵]; facets of a plane
/// through `from` may be missing.
double spread_of(const Solid& solid, const Eigen::Vector3d& from);

/// All corners, each once [m].
std::vector<Eigen::Vector3d> corners_of(const Solid& solid);

}  // namespace plumb
