// SPDX-License-Identifier: MIT
#include "manifold/ball_contact.h"

#include "manifold/support.h"

namespace plumb {
namespace {

bool is_ball(const Part& part) { return part.shape.kind == ShapeKind::sphere; }

bool has_closed_form(ShapeKind kind) {
    return kind == ShapeKind::sphere || kind == ShapeKind::box || kind == ShapeKind::capsule ||
           kind == ShapeKind::cylinder || kind == ShapeKind::cone;
}

}  // namespace

bool closed_form_gap(double& gap, Vec3& normal, const Part& a, const Part& b) {
    if (!is_ball(a) && !is_ball(b)) return false;
    const Part &ball = is_ball(a) ? a : b, &other = is_ball(a) ? b : a;
    SurfacePoint nearest;
    if (!has_closed_form(other.shape.kind) ||
        !signed_distance(nearest, other, ball.world.origin, 1e300))
        return false;
    gap = nearest.distance - ball.shape.radius;
    normal = is_ball(a) ? nearest.normal : -nearest.normal;
    return true;
}

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
