// SPDX-License-Identifier: MIT
/// A convex part against a mesh: FCL's tree names the triangles near it, and each is asked about as
/// a flat convex shape of its own.
#pragma once

#include "manifold/manifold.h"

#include <memory>

namespace plumb::by_fcl {

/// Keeps memory between questions, and nothing else.
class Triangles {
public:
    Triangles();
    ~Triangles();
    Triangles(const Triangles&) = delete;
    Triangles& operator=(const Triangles&) = delete;

    /// Adds the contacts of a mesh and a convex part that is no half-space, a before b.
    void collide(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b);

private:
    void find_near(const Part& mesh, const Part& convex);
    void take_triangle(const Part& mesh, std::uint32_t index);
    bool collide_one(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b,
                     bool faces);

    struct Scratch;
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace plumb::by_fcl
