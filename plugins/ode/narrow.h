// SPDX-License-Identifier: MIT
/// What ODE says about a pair, and how it becomes contacts.
#pragma once

#include "manifold/mesh_manifold.h"
#include "ode/geoms.h"

namespace plumb::ode {

/// Where contacts go.
struct Output {
    ContactList& contacts;
    DetectStats& stats;
};

/// What ODE says about the triangles of a mesh or height field near a convex part, kept while the
/// pair is walked through. Triangles that ODE does not name, and hulls, on which ODE is silent, get
/// the closest points computed beside it.
class TriangleAnswers final : public TriangleOracle {
public:
    void begin(const Part& a, const Part& b) override;
    bool ask(Witness& witness, const Part& a, const Part& b, std::uint32_t id) override;

private:
    bool find(Witness& witness, const Part& a, const Part& b, std::uint32_t id) const;

    struct Named {
        std::uint32_t id;
        Witness witness;
    };
    std::vector<Named> named_;  ///< sorted by id, each once: the deepest
};

/// What a worker keeps from pair to pair: memory only.
struct Workspace {
    TriangleAnswers answers;
    MeshScratch scratch;
};

/// Contacts of two parts, a before b; both are convex, or half-spaces.
void collide_convex(Output out, const Part& a, const Part& b);

/// Contacts of two parts of which at least one is a mesh or a height field.
void collide_mesh(Output out, const Part& a, const Part& b, Workspace& workspace);

/// What ODE itself says: its points and depths, nothing else.
void collide_raw(Output out, const Part& a, const Part& b);

}  // namespace plumb::ode
