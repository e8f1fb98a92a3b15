// SPDX-License-Identifier: MIT
/// Contacts of many triangles made few: of all points in one plane of the surface only the corners
/// of their outline stay, and the deepest.
#pragma once

#include "manifold/contact_list.h"

namespace plumb {

/// Works on the contacts from `begin` on. `surface_is_a`: whose points lie on the surface. `bend`:
/// by how much normals may differ that still are of one plane [rad], beside rounding.
void reduce_by_planes(ContactList& contacts, std::size_t begin, bool surface_is_a, double bend = 0);

}  // namespace plumb
