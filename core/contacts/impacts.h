// SPDX-License-Identifier: MIT
/// Collisions, solved by themselves before the forces of a substep.
///
/// An impact tells nothing of the forces to come. Solved together with them, its impulses would be
/// what the next substep begins from, and iterations cannot take all of that back: what fell would
/// be thrown up again. So islands in which bodies collide are first solved for velocities without
/// forces and from nothing, in two phases (Poisson's law): iterations bring the approach to rest
/// (compression), then each contact that collides gives back e times its impulse (restitution), and
/// iterations let friction, and contacts that approach anew, follow. Each single update of
/// compression loses energy, and giving back at most what was taken cannot gain any but by what
/// iterations leave: where an island has more energy at the end than before, and than what moves by
/// itself has given it, its impulses are scaled down to where it has not.
#pragma once

#include "schedule/contact_islands.h"
#include "world/world.h"

#include <vector>

namespace plumb {

class Impacts {
public:
    /// `gyroscopic`: whether bodies of unequal moments carry their angular momentum.
    explicit Impacts(bool gyroscopic) : gyroscopic_(gyroscopic) {}

    /// Change of a body's velocity.
    struct Change {
        Vector3d v = Vector3d::Zero(), w = Vector3d::Zero();
    };

    /// Takes all the memory that these pairs may need, so that an impact allocates none.
    void reserve(const World& world, const std::vector<BodyPair>& pairs);

    /// Finds the islands of `pairs` in which any two surfaces will meet within h [s] faster than
    /// √(2 g ε) and 2 g h. Returns whether there is one.
    bool find(const World& world, const std::vector<BodyPair>& pairs, double h);

    /// These islands, what they are ranges of, and the pairs of which that is made: what cannot
    /// come together is left out.
    const std::vector<ContactIsland>& colliding() const { return colliding_; }
    const ContactIslands& islands() const { return islands_; }
    const std::vector<BodyPair>& near() const { return near_; }
    /// The index in `pairs` of one of them.
    std::size_t place(std::size_t near) const { return place_[near]; }

    /// How many pairs of them are swept.
    std::size_t swept_pairs() const;
    /// Whether a pair is: it belongs to such an island.
    bool is_hit(std::size_t pair) const { return hit_[pair] != 0; }

    /// Leaves an island to others (islands/exact_impacts.h): it is swept no more.
    void leave(std::size_t island);
    bool is_left(std::size_t island) const { return left_[island] != 0; }

    /// Velocities from which collisions begin, [body] [m/s]. A pair for itself has half of what
    /// forces do in the substep, in the middle of which it collides: so it keeps its energy. Among
    /// others that would take what rests out of its rest.
    const std::vector<Vector3d>& start() const { return start_; }

    /// Calls visit(row) for the bodies of an island.
    template <class Visit>
    void each_row(std::size_t island, Visit visit) const {
        const ContactIsland& from = colliding_[island];
        for (std::uint32_t i = from.first_body; i < from.last_body; ++i)
            visit(islands_.bodies()[i]);
    }

    /// By row, for the bodies of all of them.
    std::vector<Change>& changes() { return changes_; }

    /// Adds what a body that moves by itself has done to an island [J].
    void add_work(std::size_t island, double of_driver) { driven_[island] += of_driver; }
    /// The same, by an impulse of one of its contacts on the contact's body a [N s]; nothing where
    /// neither of its bodies moves by itself.
    void add_work(const World& world, std::size_t island, std::size_t contact,
                  const Vector3d& impulse);

    /// Bounds the changes of each island by its energy, and adds them to the bodies' velocities;
    /// those that carry their momentum turn over h [s] as it then asks.
    void take(World& world, double h);

    /// The share of an island's changes, and so of its impulses, that was taken.
    double share(std::size_t island) const { return shares_[island]; }

    /// Calls visit(island, pair) for the pairs that were swept.
    template <class Visit>
    void each_swept(Visit visit) const {
        for (std::size_t i = 0; i < colliding_.size(); ++i)
            if (!left_[i]) each_pair(colliding_[i], [&](std::size_t pair) { visit(i, pair); });
    }

private:
    /// Calls visit(pair) for those of an island.
    template <class Visit>
    void each_pair(const ContactIsland& island, Visit visit) const {
        for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i)
            visit(std::size_t{place_[islands_.pairs()[i]]});
    }

    /// Marks the pairs that collide; returns the greatest speed at which any does [m/s].
    double find_hits(const World& world, const std::vector<BodyPair>& pairs, double h);
    /// Those that are no farther apart than `reach` [m].
    void find_near(const World& world, const std::vector<BodyPair>& pairs, double reach);
    /// Marks the bodies that are fast enough to collide with another; whether any is.
    bool find_fast(const Bodies& bodies, double threshold);
    void choose_start(const World& world);
    Vector3d drift(const World& world, const ContactIsland& island) const;
    double bounded_share(const World& world, std::size_t island) const;

    bool gyroscopic_;
    std::vector<BodyPair> near_;
    std::vector<std::uint32_t> place_;  // [near_]
    ContactIslands islands_;            // of near_
    std::vector<ContactIsland> colliding_;
    std::vector<std::uint8_t> left_;  // [colliding_] to others
    std::vector<double> driven_;      // [colliding_] the work of what moves by itself [J]
    std::vector<double> shares_;      // [colliding_] of the changes that were taken
    std::vector<std::uint8_t> fast_;  // [body]
    std::vector<std::uint8_t> hit_;   // [pair] whether it is swept
    std::vector<Vector3d> start_;     // [body]
    std::vector<Change> changes_;     // [row]
};

/// What a contact gives back of the impulse λ that it bore in compression: e λ, if it collided and
/// touches [N s]. mass: its effective mass along the normal [kg].
double restitution(const World& world, std::size_t contact, double lambda, double mass);

/// Of contacts that collided, those that part do so at their own speed: the recovery of overlap
/// adds nothing, for it would come on top of it.
void mark_parting(World& world, const std::vector<std::size_t>& contacts);

}  // namespace plumb
