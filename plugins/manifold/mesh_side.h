// SPDX-License-Identifier: MIT
/// One mesh of two that meet: its triangles in the world frame, and what can be asked about a point
/// near them. A closed mesh is a solid; an open one is a sheet that pushes out at its front.
#pragma once

#include "manifold/body_table.h"

namespace plumb {

class MeshSide {
public:
    explicit MeshSide(const Part& part);

    const Part& part() const { return part_; }
    const MeshTopology& topology() const { return surface_.topology(); }
    const Facet& facet(std::uint32_t f) const { return topology().facets[f]; }
    Vec3 vertex(std::uint32_t v) const { return to_outer(part_.world, topology().vertices[v]); }
    Vec3 normal(std::uint32_t f) const { return rotated(part_.world, facet(f).normal); }
    double slack() const { return slack_; }

    /// The nearest point of the surface, in its own frame, to a point of the world.
    NearestPoint nearest(Vec3 p, double within) const {
        return surface_.nearest(to_inner(part_.world, p), within);
    }

    /// Whether a point, of which `near` is the nearest point of the surface, lies inside by more
    /// than rounding; behind a sheet and not beside it.
    bool holds(Vec3 p, const NearestPoint& near) const;
    bool holds(Vec3 p) const { return holds(p, nearest(p, 1e300)); }

    /// Whether the way from p along the unit vector n meets nothing of the mesh for `length` [m].
    bool is_free(Vec3 p, Vec3 n, double length) const;

    /// Calls visit(facet) for all whose bounds meet a box in the mesh's own frame.
    template <class Visit>
    void overlapping(const Aabb& box, Visit&& visit) const {
        surface_.tree().overlapping(box, visit);
    }

    /// Whether no neighbour of a vertex reaches farther along the unit vector d; `lean`: by more
    /// than this share of its way.
    bool sticks_out(std::uint32_t vertex, Vec3 d, double lean) const;

private:
    const Part& part_;
    const Surface& surface_;
    double slack_;  ///< what rounding may do [m]
};

/// Bounds in one frame of a box in another.
Aabb box_between(const Frame& from, const Frame& to, const Aabb& box);

}  // namespace plumb
