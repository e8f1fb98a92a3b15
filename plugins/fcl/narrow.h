// SPDX-License-Identifier: MIT
/// What FCL says about a pair, and how it becomes contacts.
#pragma once

#include "manifold/mesh_manifold.h"

#include <memory>

namespace plumb::by_fcl {

/// The narrow phase of one worker. It keeps memory only: nothing of an answer stays in it.
class Narrow final : private TriangleOracle {
public:
    Narrow();
    ~Narrow();

    /// Contacts of two parts, a before b; both are convex, or half-spaces.
    void collide_convex(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

    /// Contacts of two parts of which at least one is a mesh or a height field.
    void collide_mesh(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

    /// What FCL's own `collide` says: its points and depths, nothing else.
    void collide_raw(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

private:
    bool ask(Witness& witness, const Part& a, const Part& b);
    bool ask(Witness& witness, const Part& a, const Part& b, std::uint32_t id) override;
    bool ask_boxes(Witness& witness, const Part& a, const Part& b, double grown);
    bool ask_sphere(Witness& witness, const Part& a, const Part& b);
    bool ask_collide(Witness& witness, const Part& a, const Part& b);
    void take_all(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

    struct Scratch;
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace plumb::by_fcl
