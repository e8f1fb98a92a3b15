// SPDX-License-Identifier: MIT
/// Collision or contact? A pair collides when it approaches faster than √(2 g ε) (§6, after
/// Mirtich).
///
/// Restitution is consumed once a contact and step, in the first substep that begins with the
/// surfaces touching: a collision that is still open is let through, or it would rebound early and
/// from too high. The recovery of the overlap that this makes adds no speed (the kernels leave
/// parting bodies alone).
#include "step/stages.h"

#include <cmath>

namespace plumb {
namespace {

/// Velocity of the contact's point on a against that on b, along the normal [m/s].
double closing_velocity(const Bodies& b, const Contact& c, const Vector3d& point) {
    auto velocity = [&](std::uint32_t i) -> Vector3d {
        return b.velocity[i] + b.angular_velocity[i].cross(point - b.position[i]);
    };
    return to_eigen(c.normal).dot(velocity(c.a) - velocity(c.b));
}

}  // namespace

void choose_rebounds(World& world, bool first_substep) {
    ContactTable& c = world.contacts;
    const double threshold =
        std::sqrt(2 * world.settings.gravity.norm() * world.settings.collision_depth);
    c.rebound.assign(c.found.size(), 0);
    if (first_substep) c.bounced.assign(c.found.size(), 0);
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const double e = world.surface_pair(c.found[i].a, c.found[i].b).restitution;
        if (e == 0 || c.bounced[i]) continue;
        const double u = closing_velocity(world.bodies, c.found[i], c.point[i]);
        if (-u <= threshold) continue;
        if (c.gap[i] > 0) {
            c.rebound[i] = ContactTable::kPassing;
        } else {
            c.rebound[i] = -e * u;
            c.bounced[i] = 1;
        }
    }
}

}  // namespace plumb
