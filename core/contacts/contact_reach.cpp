// SPDX-License-Identifier: MIT
#include "contacts/contact_reach.h"

#include "contacts/contact_measures.h"

#include <algorithm>

namespace plumb {
namespace {

/// How far two bodies may move towards each other within dt, turning aside [m]. Not at their
/// relative velocity: of two that fall together the lower one may be stopped.
double way_of(const World& world, const Contact& c) {
    const double dt = world.settings.dt;
    return fall_in_step(world.settings) + way_in(world.bodies, c.a, dt) +
           way_in(world.bodies, c.b, dt);
}

/// By how much a body may come further along `ahead` than its point of the contact is, as it turns
/// within dt in its bounding sphere [m].
double turn_ahead(const World& world, std::uint32_t body, const Vector3d& point,
                  const Vector3d& ahead) {
    const Bodies& b = world.bodies;
    if (b.motion[body] == Motion::fixed) return 0;
    const double radius = b.bounding_radius[body];
    const double left = std::max(0.0, radius - ahead.dot(point - b.position[body]));
    return std::min(left, b.angular_velocity[body].norm() * radius * world.settings.dt);
}

}  // namespace

bool is_out_of_reach(const World& world, const Contact& c) {
    if (c.gap <= world.settings.margin) return false;
    const Bodies& b = world.bodies;
    for (const std::uint32_t body : {c.a, c.b})
        if (b.motion[body] == Motion::kinematic) return false;
    const double near = world.settings.margin + way_of(world, c);
    if (c.gap <= near) return false;
    const bool both_turn = b.motion[c.a] != Motion::fixed && b.motion[c.b] != Motion::fixed;
    if (both_turn && spheres_are_apart(b, c.a, c.b, near)) return true;
    const Vector3d n = to_eigen(c.normal);
    const Vector3d point_a = to_eigen(c.point_a) - c.radius_a * n,
                   point_b = to_eigen(c.point_b) + c.radius_b * n;
    return c.gap > near + turn_ahead(world, c.a, point_a, -n) + turn_ahead(world, c.b, point_b, n);
}

}  // namespace plumb
