// SPDX-License-Identifier: MIT
/// Contacts of meshes: a back-end gives many points, some twice; and a mesh over a half-space needs
/// no back-end.
#pragma once

#include "manifold/manifold.h"

namespace plumb {

inline constexpr std::size_t kMostOfMesh = 16;  ///< points that a pair with a mesh keeps

/// Anchors a contact with a sphere on the sphere's centre, whatever point of it the back-end chose.
void anchor_sphere(Contact& contact, const Part& a, const Part& b);

/// Drops contacts, from `begin` on, that stand in one place with one normal; then all but
/// kMostOfMesh: the deepest stays, and those spread farthest from each other.
void tidy_mesh_points(ContactList& contacts, std::size_t begin);

/// A mesh over a half-space, a before b: its vertices.
void mesh_on_plane(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

}  // namespace plumb
