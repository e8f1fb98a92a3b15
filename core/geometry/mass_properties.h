// SPDX-License-Identifier: MIT
/// Volume, centre and inertia of a geometry of density one.
#pragma once

#include "math/types.h"
#include "scene/geometry.h"

namespace plumb {

struct MassProperties {
    double volume = 0;                    ///< [m³]
    Vector3d centre = Vector3d::Zero();   ///< centre of mass, geometry frame [m]
    Matrix3d inertia = Matrix3d::Zero();  ///< about the centre, geometry's axes, density 1 [m⁵]
};

/// Planes, height fields and open or inside-out meshes have no volume: 0 comes back.
MassProperties mass_properties(const Geometry& geometry);

/// Radius about `centre` that holds the geometry [m]; infinite for a plane.
double bounding_radius(const Geometry& geometry, const Vector3d& centre);

}  // namespace plumb
