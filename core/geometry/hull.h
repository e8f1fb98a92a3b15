// SPDX-License-Identifier: MIT
/// Convex hull of points (by qhull), with polygons for faces.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace plumb {

struct Hull {
    std::vector<Eigen::Vector3d> vertices;  ///< corners of the hull, some of the points given [m]
    std::vector<std::vector<std::uint32_t>>
        faces;  ///< convex polygons, counter-clockwise from outside
};

/// The hull of at least four finite points. Neighbouring facets that lie in one plane within a
/// millionth of the hull's size are one face. Throws BadShape when the points have no volume, or
/// qhull gives up.
Hull convex_hull(const std::vector<Eigen::Vector3d>& points);

}  // namespace plumb
