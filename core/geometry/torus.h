// SPDX-License-Identifier: MIT
/// A torus about the y axis, as a compound of convex wedges that contain it.
#pragma once

#include "scene/geometry.h"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace plumb {

struct Torus {
    double ring_radius = 0;       ///< of the circle that the tube's centre runs along [m]
    double tube_radius = 0;       ///< [m], less than ring_radius
    std::uint32_t segments = 24;  ///< wedges along the ring
    std::uint32_t sides = 12;     ///< of a wedge's outline
};

/// Wedges side by side, whose union contains the torus and touches it on each side of each wedge.
std::vector<GeometryPart> wedges_of(const Torus& torus);

/// Corners of a wedge's outline, in the plane of the distance from the axis and y [m].
std::vector<Eigen::Vector2d> outline_of(const Torus& torus);

}  // namespace plumb
