// SPDX-License-Identifier: MIT
/// What contacts push with, as a world remembers it of its last substep.
#pragma once

#include "world/world.h"

namespace plumb::study {

/// Sum of what the contacts of a body push it with; world frame [N].
inline Vector3d contact_force_on(const World& w, std::uint32_t body) {
    const ContactTable& contacts = w.contacts;
    Vector3d impulse = Vector3d::Zero();
    for (std::size_t i = 0; i < contacts.memory.size(); ++i) {
        const Contact& c = contacts.found[i];
        if (c.a != body && c.b != body) continue;
        const ContactMemory& m = contacts.memory[i];
        const Vector3d on_a = m.normal_impulse * to_eigen(c.normal) + m.friction_impulse;
        impulse += c.a == body ? on_a : Vector3d(-on_a);
    }
    return impulse * (w.settings.substeps / w.settings.dt);
}

}  // namespace plumb::study
