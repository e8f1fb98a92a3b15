// SPDX-License-Identifier: MIT
/// Of several ways out of an overlap of two meshes, the shortest.
#pragma once

#include "manifold/contact_list.h"
#include "manifold/mesh_side.h"

namespace plumb {

/// Contact::reserved, until the pair is done: the point that lies inside the other mesh is b's.
inline constexpr std::uint32_t kBodyIsB = 1;

/// Drops contacts, from `begin` on, whose point leaves the other mesh when all that touches along
/// another normal is parted along that normal, by a shorter way than the contact's own.
void keep_shortest_ways(ContactList& contacts, std::size_t begin, const MeshSide& a,
                        const MeshSide& b);

}  // namespace plumb
