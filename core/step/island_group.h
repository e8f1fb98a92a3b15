// SPDX-License-Identifier: MIT
/// The islands that are solved exactly: from the world's tables to the solver's, and back.
///
/// Their contacts are taken out of the sweeps, and their ties out of the trees and iterations.
#pragma once

#include "constraints/contact.h"
#include "contacts/contact_sums.h"
#include "effects/plan.h"
#include "effects/report.h"
#include "schedule/workers.h"
#include "solve/island_residuals.h"
#include "step/island_account.h"
#include "step/island_choice.h"
#include "step/island_effort.h"
#include "step/island_solver.h"
#include "step/island_ties.h"
#include "world/world.h"

#include <vector>

namespace plumb {

class IslandGroup {
public:
    /// `solved`: which ties are solved here, written once a step.
    IslandGroup(const Plan& plan, Workers& workers, SolvedTies& solved);

    /// Once a step: takes the pairs of its islands out of `pairs`, and the impulses that their
    /// contacts remember.
    void load(const World& world, std::vector<BodyPair>& pairs);

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
    struct Member {
        std::uint32_t first_body, last_body, first_point, last_point;
        IslandTieRange ties;
        double speed;  // at which its contacts and ties would part in this substep [m/s]
        BlockCholesky::Pattern pattern;
        BlockCholesky system;
        bool is_large;  // beyond Settings::exact_islands
        bool may_be_disputed;
        bool may_give_up;       // its joints, where they stay open: sweeps do no worse
        bool is_meshed;         // by ties that others only iterate, and nothing drives it
        bool is_driven;         // kinematic bodies move it
        bool gains_nothing;     // no lid, motor or spring does work on it
        bool flies;             // it touches and hangs by nothing that is immovable
        std::uint8_t settling;  // steps that are left, see island_effort.h
        bool stirred;           // in this step
        std::uint8_t disputed;  // steps that are left, see island_effort.h
        double overlap;         // of all its contacts [m], if it may be disputed
        double overlap_before;  // the same when it began to be opened apart [m]
        IslandEffort effort;    // in this step
        bool is_deep;           // some of it overlaps too deeply for an exact solution
        bool splits;            // in this step: what is swept is opened apart from velocities
        bool opens;             // the same of a heap that moves, and something overlaps by much
        bool solved;
        bool bounces;   // in this substep
        bool parts;     // in this substep, and must gain nothing by it
        bool was_open;  // at the start of this substep
        bool was_torn;  // the same, so far that it is torn
        double open;    // the worst tie [m], [rad]
        bool given_up;  // in this step: its ties could not be closed
        IslandAccount account;
        bool moves;     // a heap (step/island_account.h), at the start of the step
        bool moved_on;  // and sweeps did not bring it to rest
    };
    bool take(const World& world, const ContactIsland& island, const ContactIslands& found,
              const std::vector<BodyPair>& pairs);
    bool find_system(const World& world, Member& member, const ContactIsland& island,
                     const ContactIslands& found, const std::vector<BodyPair>& pairs);
    void set_aside(const World& world, const ContactIsland& island, const ContactIslands& found,
                   const std::vector<BodyPair>& pairs);
    bool is_shallow(const World& world, const Member& member) const;
    void choose_effort(const World& world, Member& member, bool swept);
    static void begin_dispute(Member& member);
    void add_point(const World& world, std::uint32_t contact, std::uint32_t a, std::uint32_t b);
    void take_memory(const World& world);
    void take_geometry(const World& world);
    void take_geometry(const World& world, IslandPoint& point, std::uint32_t contact) const;
    void solve(const World& world, IslandSolver& solver, Member& member);
    IslandAccount account_of(const World& world, const Member& member) const;
    static void give_up_if_in_vain(Member& member);
    bool solve_system(IslandSolver& solver, Member& member, IslandEffort effort);
    void note_open(StepReport& report, const Member& member) const;
    bool is_pulled_apart(const World& world, const Member& member);
    void give_way(IslandSolver& solver, Member& member);
    bool is_flung(const Member& member);
    void hold_torn(IslandSolver& solver, Member& member);
    void draw_together(IslandSolver& solver, Member& member);
    void close_gently(IslandSolver& solver, Member& member);
    void bound_energy(IslandSolver& solver, Member& member);
    void bound_speed(const World& world, const Member& member);
    double speed_of(const World& world, const Member& member, double h, const PushOut& push_out);
    double strongest(const World& world, const Member& member, double h);
    double thrust_of(const World& world, const Member& member, double h) const;
    bool ask(const World& world, const Member& member, std::size_t point, double h,
             const PushOut& push_out);
    double torn_from(const World& world, const Member& member, double h) const;
    double open_at_start(const Member& member);
    void forget_impulses();
    void forget_what_whirls(const Member& member);
    void apply_impulses();
    Island island_of(const Member& member);
    std::span<const Vector6d> starts_of(const Member& member) const;
    std::span<const Vector6d> velocities_of(const Member& member) const;

    Workers& workers_;
    SolvedTies& solved_;
    bool has_friction_, resists_rolling_;
    IslandChoice choice_;
    std::vector<std::uint8_t> taken_;  // [pair]
    std::vector<BodyPair> set_aside_;  // whose islands would take too much
    std::uint32_t costly_ = 0;         // of those islands
    BlockCholesky::Pattern pattern_;

    std::vector<Member> members_;  // the first count_ are in use
    std::size_t count_ = 0;
    bool some_rest_ = true;  // of the ties, as far as is known
    bool is_fresh_ = false;  // whether arms and inertia are those of the substep that begins
    std::vector<IslandBody> bodies_;
    std::vector<Vector6d> start_, velocity_, force_;  // [body]
    std::vector<Vector6d> shift_;  // [body] see open_apart, as a velocity over the substep
    double h_ = 0;                 // the substep [s]
    std::vector<IslandPoint> points_;
    std::vector<std::uint8_t> locked_;  // [point] whether it is pushed out no more
    std::vector<double> opening_;       // [point] speed at which it is opened apart [m/s]
    std::vector<double> parting_;       // [point] of the speed asked for, what may be too much
    IslandTies ties_;
    std::vector<std::uint32_t> tied_;      // bodies of one tie
    std::vector<std::uint32_t> contacts_;  // [point] in the contact table
    std::vector<IslandSolver> solvers_;    // [worker]
};

}  // namespace plumb
