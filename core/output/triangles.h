// SPDX-License-Identifier: MIT
/// Shapes as triangles, for those who draw.
#pragma once

#include "scene/geometry.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace plumb {

/// Triangles that share vertices, counter-clockwise from outside.
struct TriangleMesh {
    std::vector<Eigen::Vector3f> vertices;  ///< [m]
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The surface of a shape in its own frame; triangles that name no vertex are left out. Round
/// shapes are outlined so finely that a picture does not show it. A plane, a sphere and a compound
/// have no triangles here.
TriangleMesh triangles_of(const Geometry& geometry);

}  // namespace plumb
