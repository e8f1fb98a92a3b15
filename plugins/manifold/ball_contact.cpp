// SPDX-License-Identifier: MIT
#include "manifold/ball_contact.h"

#include "manifold/support.h"

namespace plumb {

void fill_ball_contact(Contact& c, Vec3 centre, double radius, const Part& part,
                       const SurfacePoint& nearest) {
    c.normal = nearest.normal;
    c.point_a = centre;
    c.radius_a = radius;
    c.radius_b = core_radius(part);
    c.point_b = nearest.point - c.radius_b * c.normal;
    c.gap = nearest.distance - radius;
    c.flags = kContactExact;
    if (!part.in_compound) c.part_b = nearest.triangle;
}

void turn_round(Contact& c) {
    std::swap(c.a, c.b);
    std::swap(c.point_a, c.point_b);
    std::swap(c.radius_a, c.radius_b);
    std::swap(c.part_a, c.part_b);
    c.normal = -c.normal;
}

}  // namespace plumb
