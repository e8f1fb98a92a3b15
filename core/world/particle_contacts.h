// SPDX-License-Identifier: MIT
/// Contacts of particles with bodies, of the present step and of the step before.
#pragma once

#include <plumb/contact_set.h>

#include "math/types.h"

#include <vector>

namespace plumb {

/// What a contact of a particle remembers while it lasts.
struct ParticleContactMemory {
    double normal_impulse = 0;                     ///< of the last substep [N s]
    Vector3d friction_impulse = Vector3d::Zero();  ///< world frame [N s]
};

/// Columns of one length: [contact], sorted by particle (Contact::a), body (b) and part.
struct ParticleContactTable {
    std::vector<Contact> found;
    std::vector<ParticleContactMemory> memory;
    std::vector<Vector3d> track;  ///< b's point in its body's frame [m]

    std::vector<Contact> found_before;
    std::vector<ParticleContactMemory> memory_before;
};

}  // namespace plumb
