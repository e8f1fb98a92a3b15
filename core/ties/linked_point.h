// SPDX-License-Identifier: MIT
/// The points of a link at the start of a substep, out of the world's tables.
#pragma once

#include "constraints/link.h"
#include "world/point_place.h"

namespace plumb {

inline LinkedPoint linked_point(const World& world, const WorldPoint& p) {
    LinkedPoint point;
    point.start = place_of(world, p);
    if (p.particle != kNoIndex) {
        point.inverse.mass = world.particles.inverse_mass[p.particle];
    } else if (p.body != kNoIndex) {
        point.arm = point.start - world.bodies.position[p.body];
        point.inverse = {world.bodies.inverse_mass[p.body],
                         world.bodies.world_inverse_inertia[p.body]};
    }
    return point;
}

/// z = h² ω² of the swing across a link that pulled so hard in the substep before.
inline double link_load(const Link& link, const LinkedPoint& a, const LinkedPoint& b, double h) {
    const Vector3d apart = a.start - b.start;
    const double length = apart.norm();
    if (!(length > 0)) return 0;
    return h * link.impulse.norm() * line_response(a, b, line_of(apart)) / length;
}

}  // namespace plumb
