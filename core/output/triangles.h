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

/// The surface of a hull, a mesh or a height field; corners that name no vertex are left out.
TriangleMesh triangles_of(const Geometry& geometry);

}  // namespace plumb
