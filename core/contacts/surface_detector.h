// SPDX-License-Identifier: MIT
/// Finds points near surfaces that deform, which no collider knows: particles of other deformables
/// and of the same one, and the corners of bodies.
#pragma once

#include "geometry/corner_points.h"
#include "schedule/box_grid.h"
#include "world/world.h"

#include <cstdint>
#include <vector>

namespace plumb {

class SurfaceDetector {
public:
    /// Takes the surfaces and the bodies' corners of a world, until bodies come or go.
    explicit SurfaceDetector(const World& world);

    /// Fills World::surface_contacts with what may touch within dt [s].
    void detect(World& world, double dt);

private:
    struct Triangle {
        std::array<std::uint32_t, 3> corners;  ///< particles
        std::uint32_t deformable;
    };
    struct Probe {
        WorldPoint point;
        std::uint32_t deformable = kNoIndex;  ///< of the point; else it is of a body
        double radius = 0;                    ///< [m]
    };
    struct Near {
        std::uint32_t triangle;
        std::array<double, 3> weights;
        Vector3d apart;   ///< from the triangle to the point [m]
        double distance;  ///< [m]
        double facing;    ///< cosine between that and the triangle's normal
    };

    void add_probes(const World& world);
    void look(World& world, const Probe& probe, double dt);
    static bool may_meet(const World& world, const Probe& probe, const Triangle& triangle);
    void keep_nearest(World& world, const Probe& probe);
    /// Whether it became a contact.
    bool add(World& world, const Probe& probe, const Near& near);

    std::vector<Triangle> triangles_;
    std::vector<Probe> probes_;
    std::vector<std::uint8_t> closed_;  ///< [deformable] whether its surface has an inside
    BoxGrid grid_;
    std::vector<Vector3d> low_, high_;                                         ///< [triangle]
    Vector3d bounds_low_ = Vector3d::Zero(), bounds_high_ = Vector3d::Zero();  ///< of all
    std::vector<Near> near_;
};

}  // namespace plumb
