// SPDX-License-Identifier: MIT
/// Contacts of particles with bodies, of the present step.
#pragma once

#include <plumb/contact_set.h>

#include "math/types.h"

#include <vector>

namespace plumb {

/// Columns of one length: [contact], sorted by particle (Contact::a), body (b) and part.
struct ParticleContactTable {
    std::vector<Contact> found;
    std::vector<Vector3d> track;  ///< b's point in its body's frame [m]
};

}  // namespace plumb
