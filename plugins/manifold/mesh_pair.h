// SPDX-License-Identifier: MIT
/// Contacts of two meshes, measured on the triangles themselves.
///
/// A contact stands where the distance of the two surfaces along a normal is least nearby: a vertex
/// over a face, two edges across each other, and, of meshes that are apart, also a vertex near an
/// edge or a vertex. The body's vertex must look towards the face, and the way out must be free: so
/// the depth is that of the solid there, not of one triangle. Of several ways out the shortest
/// stays: a contact that another's shift would part is dropped.
#pragma once

#include "manifold/contact_list.h"

namespace plumb {

/// Adds the contacts of two meshes, a before b. What one mesh wholly contains has none.
void collide_meshes(ContactList& out, DetectStats& stats, const Part& a, const Part& b);

}  // namespace plumb
