// SPDX-License-Identifier: MIT
/// The islands that are solved exactly: from the world's tables to the solver's, and back.
///
/// Their contacts are taken out of the sweeps, and their ties out of the trees and iterations.
#pragma once

#include "constraints/contact.h"
#include "contacts/contact_sums.h"
#include "effects/plan.h"
#include "effects/report.h"
#include "islands/exact_island.h"
#include "islands/island_choice.h"
#include "islands/island_columns.h"
#include "islands/island_solver.h"
#include "schedule/workers.h"
#include "solve/island_residuals.h"
#include "world/world.h"

#include <span>
#include <vector>

namespace plumb {

class IslandGroup {
public:
    /// `solved`: which ties are solved here, written once a step.
    IslandGroup(const Plan& plan, Workers& workers, SolvedTies& solved);

    /// Once a step: takes the pairs of its islands out of `pairs`, and the impulses that their
    /// contacts remember.
    void load(const World& world, std::vector<BodyPair>& pairs);

    /// The pairs of small islands of more than one body that nothing ties or drives, and that bounce
    /// or are disputed: they collide before the forces of a substep (islands/exact_impacts.h).
    const std::vector<BodyPair>& loose() const { return loose_; }

    /// Of what is left to sweeps, and why.
    const IslandChoice& choice() const { return choice_; }

    /// Once a substep of length h [s]: velocities, forces included, and what is asked of them.
    /// Returns how many contacts overlap deeper than what is pushed out.
    std::uint32_t begin(const World& world, double h, const PushOut& push_out);

    /// Reports the islands that still miss their laws, and joints that are open.
    void solve(const World& world, StepReport& report);

    /// Adds what the substep changed to the bodies' velocities.
    void take_changes(Bodies& bodies) const;

    /// At the end of a substep: moves the bodies of disputed islands apart.
    void open_apart(Bodies& bodies) const;

    /// Adds what the contacts bear in this substep.
    void add_impulses(ContactSums& sums) const;

    /// After the last substep: names the rows that each island holds together, then tells how far
    /// those are from being solved, if there are any.
    bool has_residuals() const { return count_ > 0; }
    void add_rows(const World& world, std::vector<BodyPair>& pairs) const;
    void add_residuals(const World& world, IslandResiduals& islands);

    /// Once a substep, impulses of ties; once a step, those of contacts.
    void store_tie_impulses(World& world) const;
    void store_impulses(ContactTable& contacts) const;

    /// Once a step: which ties are left to others for a while.
    void rest_ties(World& world);

private:
    std::span<ExactIsland> taken() { return std::span(islands_).first(count_); }
    std::span<const ExactIsland> taken() const { return std::span(islands_).first(count_); }

    bool take(const World& world, const ContactIsland& from, const std::vector<BodyPair>& pairs);
    bool find_system(const World& world, ExactIsland& island, const ContactIsland& from,
                     const std::vector<BodyPair>& pairs);
    void find_nature(const World& world, ExactIsland& island, const ContactIsland& from,
                     const std::vector<BodyPair>& pairs) const;
    void note_loose(const World& world, const ExactIsland& island, const ContactIsland& from,
                    const std::vector<BodyPair>& pairs);
    void fill_columns(const World& world, ExactIsland& island, const ContactIsland& from,
                      const std::vector<BodyPair>& pairs);
    IslandAccount account_of(const World& world, const ExactIsland& island) const;
    void set_aside(const World& world, const ContactIsland& from,
                   const std::vector<BodyPair>& pairs);
    bool is_shallow(const World& world, const ExactIsland& island) const;
    void recall(const World& world, ExactIsland& island) const;
    void choose_effort(const World& world, ExactIsland& island, bool swept) const;
    void note_open(StepReport& report, const ExactIsland& island) const;

    Workers& workers_;
    SolvedTies& solved_;
    IslandChoice choice_;
    std::vector<std::uint8_t> is_taken_;  // [pair]
    std::vector<BodyPair> loose_;
    std::vector<BodyPair> set_aside_;  // whose islands would take too much
    std::uint32_t costly_ = 0;         // of those islands
    IslandSystem::Pattern pattern_;    // memory of find_system, as the next
    IslandSystem::Spare spare_;        // memory of a large one
    std::vector<std::uint32_t> tied_;  // bodies of one tie

    std::vector<ExactIsland> islands_;  // the first count_ are in use
    std::size_t count_ = 0;
    IslandColumns columns_;
    bool some_rest_ = true;  // of the ties, as far as is known
    bool is_fresh_ = false;  // whether arms and inertia are those of the substep that begins
    std::vector<IslandSolver> solvers_;  // [worker]
};

}  // namespace plumb
