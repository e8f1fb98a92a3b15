// SPDX-License-Identifier: MIT
/// ODE's geoms for our parts.
///
/// ODE's capsules and cylinders lie along z, ours along y, so their geoms are turned by a quarter.
/// A sphere and a capsule have a second geom, wider by the distance of detection: for round shapes
/// that is exact, and makes ODE answer before they touch.
#pragma once

#include "manifold/manifold.h"

#include <ode/ode.h>

#include <memory>

namespace plumb::ode {

/// What hangs on a part.
struct Geoms {
    Geoms() = default;
    Geoms(const Geoms&) = delete;
    Geoms& operator=(const Geoms&) = delete;
    ~Geoms();

    dGeomID exact = nullptr;
    dGeomID wide = nullptr;  ///< sphere, capsule; else nullptr
    double wider_by = 0;     ///< [m]
    Vec3 centre{};           ///< of a hull, in its own frame: a point inside, which ODE wants [m]
    std::vector<dReal> planes, points;  ///< behind a hull
    std::vector<unsigned> polygons;     ///< behind a hull
    dTriMeshDataID mesh = nullptr;      ///< behind a mesh or height field
    std::vector<dTriIndex> corners;     ///< behind a height field

    /// The geom that answers up to the distance of detection where there is one.
    dGeomID widest() const { return wide ? wide : exact; }
};

inline Geoms& geoms_of(const Part& part) { return *static_cast<Geoms*>(part.backend.get()); }

std::shared_ptr<Geoms> make_geoms(const Part& part);

/// Moves a part's geoms to its world frame; wide ones grow by `wider_by` [m].
void place_geoms(const Part& part, double wider_by);

}  // namespace plumb::ode
