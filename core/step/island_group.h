// SPDX-License-Identifier: MIT
/// The islands that are solved exactly: from the world's tables to the solver's, and back.
///
/// Their contacts are taken out of the sweeps. An island is solved exactly where no joint holds its
/// bodies, it has at most Settings::exact_islands of them, and, unless it is very small, it is
/// calm: what flies and tumbles needs no exact forces, and they would cost most there. Sweeps are
/// enough for a body that rolls or slides on what is immovable; one that hardly moves shall not
/// creep.
#pragma once

#include "constraints/contact.h"
#include "contacts/contact_sums.h"
#include "effects/plan.h"
#include "schedule/contact_islands.h"
#include "schedule/workers.h"
#include "step/island_solver.h"
#include "world/world.h"

#include <vector>

namespace plumb {

class IslandGroup {
public:
    IslandGroup(const Plan& plan, Workers& workers);

    /// Once a step: takes the pairs of its islands out of `pairs`, and the impulses that their
    /// contacts remember.
    void load(const World& world, std::vector<BodyPair>& pairs);

    /// Whether a contact that was solved exactly goes on from its impulses in the sweeps, to which
    /// its island is left because it has grown, or some of it moves, is jammed or overlaps deeply.
    /// It does unless
    ///   - one of its bodies touches what is jammed or too deep,
    ///   - it moves,
    ///   - or it bears more than the island weighs:
    /// what is jammed or was hit may hold each other by more than sweeps can take back.
    bool goes_on(const World& world, std::uint32_t contact) const;

    /// Once a substep of length h [s]: velocities, forces included, and what is asked of them.
    /// Returns how many contacts overlap deeper than what is pushed out.
    std::uint32_t begin(const World& world, double h, const PushOut& push_out);

    /// Returns how many islands still miss the law of contact.
    std::uint32_t solve();

    /// Adds what the substep changed to the bodies' velocities.
    void take_changes(Bodies& bodies) const;

    /// Adds what the contacts bear in this substep.
    void add_impulses(ContactSums& sums) const;

    void store_impulses(ContactTable& contacts) const;

private:
    struct Member {
        std::uint32_t first_body, last_body, first_point, last_point;
        double speed;  // at which its contacts would approach in this substep [m/s]
        BlockCholesky::Pattern pattern;
        BlockCholesky system;
        bool solved;
    };
    bool is_exact(const World& world, const ContactIsland& island,
                  const std::vector<BodyPair>& pairs);
    void find_upset(const World& world, const ContactIsland& island,
                    const std::vector<BodyPair>& pairs);
    void mark_what_goes_on(const World& world, const ContactIsland& island,
                           const std::vector<BodyPair>& pairs);
    bool is_slow(const World& world, const Contact& contact) const;
    bool is_calm(const World& world, const ContactIsland& island,
                 const std::vector<BodyPair>& pairs) const;
    void mark_jointed(const World& world);
    void mark(const World& world, const BodyPair& pair, double bears);
    double weight_of(const World& world, const ContactIsland& island,
                     const std::vector<BodyPair>& pairs);
    void take(const World& world, const ContactIsland& island, const std::vector<BodyPair>& pairs);
    void add_point(const World& world, std::uint32_t contact, std::uint32_t a, std::uint32_t b);
    void take_memory(const World& world);
    void take_geometry(const World& world);
    void take_geometry(const World& world, IslandPoint& point, std::uint32_t contact) const;
    bool is_stuck(const ContactMemory& before, double overlap) const;
    double speed_of(const World& world, const Member& member, double h,
                    const PushOut& push_out) const;
    double strongest(const World& world, const Member& member, double h) const;
    void ask(const World& world, std::size_t point, double h, const PushOut& push_out,
             double least);
    void apply_impulses();
    Island island_of(const Member& member);

    Workers& workers_;
    bool has_friction_, resists_rolling_;
    ContactIslands found_;
    std::vector<std::uint8_t> jointed_;  // [dynamic row]
    std::vector<double> bears_;          // [dynamic row], see goes_on [N s]
    std::vector<std::uint8_t> weighed_;  // [body of an island]
    std::vector<BodyPair> upset_;        // of an island: what is jammed or too deep
    std::vector<std::uint8_t> taken_;    // [pair]
    BlockCholesky::Pattern pattern_;

    std::vector<Member> members_;  // the first count_ are in use
    std::size_t count_ = 0;
    double stuck_share_ = 1;  ///< of an overlap, from which it counts as left as it was
    bool is_fresh_ = false;   // whether arms and inertia are those of the substep that begins
    std::vector<IslandBody> bodies_;
    std::vector<Vector6d> start_, velocity_, force_;  // [body]
    std::vector<IslandPoint> points_;
    std::vector<std::uint8_t> locked_;     // [point] whether it is pushed out no more
    std::vector<std::uint32_t> jammed_;    // contacts that are left to sweeps until they are out
    std::vector<std::uint32_t> contacts_;  // [point] in the contact table
    std::vector<IslandSolver> solvers_;    // [worker]
};

}  // namespace plumb
