// SPDX-License-Identifier: MIT
/// Contacts of a convex part with a mesh or a height field, triangle by triangle.
///
/// Goes in: two parts, and somebody who says for one triangle how the convex part touches it.
/// The normal is put right by the surface around the triangle (facet_normal.h), the support face of
/// the convex part is cut against the triangle along it, and what all triangles give is merged.
///
/// Surfaces are one-sided: a body is pushed out at the front. A body that has passed a mesh by more
/// than its least width is no longer touched; a height field is solid at any depth.
#pragma once

#include "manifold/manifold.h"

namespace plumb {

/// A back-end's opinion about single triangles.
class TriangleOracle {
public:
    /// Called once a pair, with the pair itself, a before b.
    virtual void begin(const Part& a, const Part& b) { (void)a, (void)b; }

    /// The witness of a pair of which one part is a triangle: a hull of three vertices and one
    /// face, in the frame of its mesh. `id` is the triangle's index in the mesh. False: not near.
    virtual bool ask(Witness& witness, const Part& a, const Part& b, std::uint32_t id) = 0;

protected:
    ~TriangleOracle() = default;
};

/// Memory that a worker keeps from pair to pair; nothing of an answer stays in it.
struct MeshScratch {
    MeshScratch();
    MeshScratch(const MeshScratch&) = delete;
    MeshScratch& operator=(const MeshScratch&) = delete;

    Part triangle;  ///< a plugin may hang its own shape on `triangle.backend`
    Vec3 corners[3];
    std::vector<std::uint32_t> near;  ///< facets
    ContactList trusted;              ///< contacts along a normal that the back-end gave
    ContactList corrected;            ///< and along others
};

/// Adds the contacts of two parts, a before b: one has triangles, the other is convex and no plane.
void collide_triangles(ContactList& out, DetectStats& stats, const Part& a, const Part& b,
                       TriangleOracle& oracle, MeshScratch& scratch);

}  // namespace plumb
