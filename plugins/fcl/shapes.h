// SPDX-License-Identifier: MIT
/// FCL's geometries for our parts.
///
/// FCL's cones, capsules and cylinders lie along z, ours along y, so their frames are turned by a
/// quarter.
#pragma once

#include "manifold/manifold.h"

#include <fcl/geometry/collision_geometry.h>

#include <memory>

namespace plumb::by_fcl {

/// What hangs on a part. The frame changes between detections; the geometry never does, so that
/// several threads may read it.
struct Geometry {
    std::shared_ptr<fcl::CollisionGeometryd> shape;
    fcl::Transform3d place = fcl::Transform3d::Identity();  ///< FCL's frame → world
};

inline Geometry& geometry_of(const Part& part) {
    return *static_cast<Geometry*>(part.backend.get());
}

std::shared_ptr<Geometry> make_geometry(const Part& part);

/// Moves a part's geometry to its world frame.
void place_geometry(const Part& part);

inline fcl::Vector3d to_fcl(Vec3 v) { return {v.x, v.y, v.z}; }
inline Vec3 from_fcl(const fcl::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace plumb::by_fcl
