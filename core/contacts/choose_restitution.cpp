// SPDX-License-Identifier: MIT
/// Collision or contact? A pair collides when it approaches faster than √(2 g ε) (§6, after
/// Mirtich).
///
/// Restitution is consumed once a collision, in the first substep that begins with the surfaces
/// touching; what has parted as fast may collide again in the same step. A collision that is still
/// open is let through, or it would bounce early and from too high. The recovery of the overlap
/// that this makes adds no speed (the kernels leave parting bodies alone), nor does that of what
/// turned into another body and parts from it as fast as what collides.
#include "contacts/contact_measures.h"
#include "contacts/contact_stages.h"

namespace plumb {

void choose_restitution(World& world, bool first_substep) {
    ContactTable& c = world.contacts;
    const double threshold = collision_threshold(world.settings);
    c.restitution.assign(c.found.size(), Restitution::none);
    c.restitution_velocity.assign(c.found.size(), 0);
    if (first_substep) c.bounced.assign(c.found.size(), 0);
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const double e = world.surface_pair(c.found[i].a, c.found[i].b).restitution;
        if (e == 0) continue;
        const double u = separating_velocity(world.bodies, c.found[i], c.point[i]);
        if (u > threshold && c.gap[i] < 0) c.set_restitution(i, ContactTable::kParting);
        if (u > threshold) c.bounced[i] = 0;
        if (c.bounced[i]) continue;
        if (-u <= threshold) continue;
        if (is_open(world, i)) {
            c.restitution[i] = Restitution::passing;
        } else {
            c.set_restitution(i, -e * u);
            c.bounced[i] = 1;
        }
    }
}

}  // namespace plumb
