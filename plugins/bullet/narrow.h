// SPDX-License-Identifier: MIT
/// What Bullet says about a pair, and how it becomes contacts.
#pragma once

#include "bullet/shapes.h"
#include "manifold/mesh_manifold.h"

namespace plumb::bullet {

/// Bullet's solvers and algorithms, kept for their memory only: nothing of an answer stays in them.
class Narrow final : private TriangleOracle {
public:
    Narrow();

    /// Contacts of two parts, a before b; both are convex, or half-spaces.
    void collide_convex(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

    /// Contacts of two parts of which at least one is a mesh or a height field.
    void collide_mesh(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

    /// What Bullet itself says: points and depths of its own algorithm for the pair, nothing else.
    void collide_raw(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

private:
    bool ask(Witness& witness, const Part& a, const Part& b);
    bool ask(Witness& witness, const Part& a, const Part& b, std::uint32_t id) override;
    bool ask_boxes(Witness& witness, const Part& a, const Part& b, bool grown);
    bool ask_closest(Witness& witness, const Part& a, const Part& b);

    MeshScratch scratch_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
};

}  // namespace plumb::bullet
