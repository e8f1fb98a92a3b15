// SPDX-License-Identifier: MIT
/// The surface of a deformable in one frame, for rays: triangles whose normals are blended between
/// their corners.
#pragma once

#include "output/recorded_deformable.h"
#include "output/triangles.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace plumb {

/// Cosine of the angle between triangles from which on a deformable's edge is drawn as an edge:
/// solids have edges, sheets are smooth however they fold.
double crease_cosine(DeformableKind kind);

class SmoothSurface {
public:
    SmoothSurface(TriangleMesh mesh, double crease_cosine);

    const TriangleMesh& mesh() const { return mesh_; }

    /// Place on a triangle, by the shares of its second and third corner.
    struct Place {
        std::uint32_t triangle;
        float u, v;
    };
    struct Look {
        Eigen::Vector3f normal;   ///< unit
        Eigen::Vector3f rounded;  ///< the place on a surface as round as the normals say [m]
    };

    /// What a ray of a direction sees, which is the side of the triangle that is towards it.
    ///
    /// Rays that start from the rounded place do not meet the neighbours of a triangle that lies
    /// flatter than the surface that it stands for (Hanika, "Hacking the shadow terminator", 2021).
    Look look(const Place& place, const Eigen::Vector3f& direction) const;

private:
    TriangleMesh mesh_;
    std::vector<std::array<Eigen::Vector3f, 3>> normals_;  ///< [triangle][corner], unit
};

/// The surface of a deformable relative to a place; nothing where it has none. Triangles that are
/// torn, or have a point that is not finite, are left out.
std::optional<SmoothSurface> surface_of(const RecordedDeformable& deformable, const Frame& frame,
                                        const Eigen::Vector3d& middle);

}  // namespace plumb
