// SPDX-License-Identifier: MIT
/// Ties: what holds two or more bodies together for as long as it lives, unlike a contact.
#pragma once

#include "math/disjoint_sets.h"
#include "world/world.h"

#include <algorithm>
#include <cstdint>

namespace plumb {

enum class TieKind : std::uint8_t { joint, link, coupling };

/// An entry of the world's joints, links or couplings.
struct Tie {
    TieKind kind;
    std::uint32_t index;
};

/// Visits the bodies that a tie holds together, and kNoIndex for the world; a body of two coupled
/// joints twice.
template <class Visit>
void each_body(const World& world, const Tie& tie, Visit visit) {
    const auto of_joint = [&](std::uint32_t i) {
        visit(world.joints.joints[i].a), visit(world.joints.joints[i].b);
    };
    switch (tie.kind) {
        case TieKind::joint:
            return of_joint(tie.index);
        case TieKind::link:
            return visit(world.links[tie.index].a.body), visit(world.links[tie.index].b.body);
        case TieKind::coupling:
            of_joint(world.joints.couplings[tie.index].joint_a);
            of_joint(world.joints.couplings[tie.index].joint_b);
    }
}

/// Unites the bodies of a tie that move.
inline void unite_bodies(const World& world, const Tie& tie, DisjointSets& sets) {
    std::uint32_t before = kNoIndex;
    each_body(world, tie, [&](std::uint32_t body) {
        if (body == kNoIndex || !(world.bodies.inverse_mass[body] > 0)) return;
        if (before != kNoIndex) sets.unite(before, body);
        before = body;
    });
}

/// Whether a tie holds anything: nothing does that is broken, or sleeps.
inline bool holds(const World& world, const Tie& tie) {
    const auto acts = [&](std::uint32_t i) { return world.acts(world.joints.joints[i]); };
    if (tie.kind == TieKind::joint) return acts(tie.index);
    if (tie.kind == TieKind::link) return true;
    const JointCoupling& c = world.joints.couplings[tie.index];
    return acts(c.joint_a) && acts(c.joint_b);
}

/// For how long exact islands leave a joint or a link alone; of a coupling its joints tell.
template <class SomeWorld>
auto& rest_of(SomeWorld& world, const Tie& tie) {
    return tie.kind == TieKind::joint ? world.joints.joints[tie.index].island_rest
                                      : world.links[tie.index].island_rest;
}

/// What exact islands and the systems of sheets solve in a step, so that others leave it alone: by
/// index in the world's tables.
struct SolvedTies {
    std::vector<std::uint8_t> joints, links, couplings;

    explicit SolvedTies(const World& world)
        : joints(world.joints.size(), 0),
          links(world.links.size(), 0),
          couplings(world.joints.couplings.size(), 0) {}

    template <class Solved>
    static auto& column(Solved& solved, const Tie& tie) {
        if (tie.kind == TieKind::joint) return solved.joints;
        return tie.kind == TieKind::link ? solved.links : solved.couplings;
    }

    void mark(const Tie& tie) { column(*this, tie)[tie.index] = 1; }
    bool has(const Tie& tie) const { return column(*this, tie)[tie.index] != 0; }
    bool any_joint() const { return std::find(joints.begin(), joints.end(), 1) != joints.end(); }
    void clear() {
        for (auto* column : {&joints, &links, &couplings})
            std::fill(column->begin(), column->end(), 0);
    }
};

}  // namespace plumb
