// SPDX-License-Identifier: MIT
#include "contacts/contact_reach.h"

#include "contacts/contact_measures.h"

#include <algorithm>

namespace plumb {
namespace {

/// By how much a body may come further along `ahead` than its point of the contact is now, within
/// dt: its way, and what is left of its bounding sphere [m].
double reach(const World& world, std::uint32_t body, const Vector3d& point, const Vector3d& ahead) {
    const Bodies& b = world.bodies;
    if (b.motion[body] == Motion::fixed) return 0;
    const double dt = world.settings.dt, radius = b.bounding_radius[body];
    const double way =
        b.velocity[body].norm() * dt + b.force[body].norm() * b.inverse_mass[body] * dt * dt;
    const double left = std::max(0.0, radius - ahead.dot(point - b.position[body]));
    return way + std::min(left, b.angular_velocity[body].norm() * radius * dt);
}

}  // namespace

bool is_out_of_reach(const World& world, const Contact& c) {
    const double near = world.settings.margin + fall_in_step(world.settings);
    if (c.gap <= near) return false;
    for (const std::uint32_t body : {c.a, c.b})
        if (world.bodies.motion[body] == Motion::kinematic) return false;
    const Vector3d n = to_eigen(c.normal);
    const Vector3d point_a = to_eigen(c.point_a) - c.radius_a * n,
                   point_b = to_eigen(c.point_b) + c.radius_b * n;
    return c.gap > near + reach(world, c.a, point_a, -n) + reach(world, c.b, point_b, n);
}

}  // namespace plumb
