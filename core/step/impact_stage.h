// SPDX-License-Identifier: MIT
/// The stage of a substep in which collisions are solved by themselves (contacts/impacts.h): by
/// sweeps of the contacts' rows, and exactly where those do not settle.
#pragma once

#include "contacts/impacts.h"
#include "islands/exact_impacts.h"
#include "islands/island_group.h"
#include "step/contact_solver.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace plumb {

/// Sweeps of each phase of an impact: these, and as many again until velocities change in one of
/// them by no more than a share of the greatest, or that comes to so many solutions of a pair. What
/// runs along a row takes as many as the square of its length. Joints would have to take part in
/// that; and where friction wedges what does not bounce, sweeps that are not enough only delay its
/// rest.
inline constexpr std::size_t kImpactSweeps = 10, kImpactWork = 10000, kImpactLook = 500;
inline constexpr double kImpactSettled = 1e-6;

template <class Real, int W>
class ImpactStage {
public:
    using Contacts = ContactSolver<Real, W>;

    ImpactStage(const Settings& settings, const Plan& plan, Workers& workers)
        : workers_(workers),
          has_friction_(plan.runs(Effect::friction)),
          most_exact_(plan.runs(Effect::exact_islands)
                          ? std::min(settings.exact_islands, kMostExactlyHit)
                          : 0),
          impacts_(carry_momentum(settings, plan.runs(Effect::gyroscopic))),
          exact_(plan) {}

    /// Once a step. `exact` (may be null): has pairs that are not among the contacts' rows.
    void load(const World& world, Contacts& contacts, const IslandGroup* exact) {
        swept_ = contacts.pairs().size();
        pairs_ = contacts.pairs();
        if (exact) pairs_.insert(pairs_.end(), exact->loose().begin(), exact->loose().end());
        impacts_.reserve(world, pairs_);
        contacts.reserve_impacts(world.contacts.found.size());
        before_.resize(static_cast<std::size_t>(world.dynamic_count));
    }

    /// Collisions that begin in a substep of h [s], before forces. Adds what they bear to the sums,
    /// if there are any.
    void solve(World& world, Contacts& contacts, VelocityTable<Real>& table, double h,
               ContactSums* sums) {
        if (pairs_.empty() || !impacts_.find(world, pairs_, h)) return;
        leave_apart();
        exact_.begin();
        sweep_all(world, contacts, table, h);
        for (std::size_t i = 0; i < impacts_.colliding().size(); ++i)
            if (impacts_.is_left(i)) exact_.solve(world, impacts_, i, h);
        if (world.kinematic_count > 0) add_work_of_drivers(world, contacts);
        impacts_.take(world, h);
        if (sums) add_to(*sums, contacts);
        contacts.end_impacts(world);
        exact_.end(world, impacts_, sums);
    }

private:
    void add_work_of_drivers(const World& world, Contacts& contacts) {
        contacts.each_impact(
            impacts_, [&](std::size_t island, std::size_t contact, const RowImpulse& p) {
                const Vector3d normal = to_eigen(world.contacts.found[contact].normal);
                impacts_.add_work(world, island, contact, p.normal * normal + p.friction());
            });
    }

    void add_to(ContactSums& sums, Contacts& contacts) {
        contacts.each_impact(impacts_,
                             [&](std::size_t island, std::size_t contact, const RowImpulse& p) {
                                 const double share = impacts_.share(island);
                                 sums.add(contact, share * p.normal, share * p.friction());
                             });
    }

    /// What has no rows is solved exactly.
    void leave_apart() {
        for (std::size_t i = 0; i < impacts_.colliding().size(); ++i) {
            const ContactIsland& island = impacts_.colliding()[i];
            const std::size_t near = impacts_.islands().pairs()[island.first_pair];
            if (impacts_.place(near) >= swept_) impacts_.leave(i);
        }
    }

    void sweep_all(World& world, Contacts& contacts, VelocityTable<Real>& table, double h) {
        table.begin(world, impacts_.start(), world.bodies.angular_velocity_now);
        PassSettings<Real> pass{};
        pass.h = static_cast<Real>(h), pass.inverse_h = static_cast<Real>(1 / h);
        contacts.begin_impacts(world, impacts_, table.rows(), pass);
        if (impacts_.swept_pairs() == 0) return;
        sweep(world, contacts, table.rows(), pass);
        if (contacts.give_back(world, impacts_, table.rows()))
            sweep(world, contacts, table.rows(), pass);
        each_swept([&](std::size_t island) {
            impacts_.each_row(island, [&](std::int32_t row) {
                const Velocity<Real> change = velocity_in(table.rows().change, row);
                impacts_.changes()[row] = {change.v.template cast<double>(),
                                           change.w.template cast<double>()};
            });
        });
    }

    /// One phase.
    void sweep(const World& world, Contacts& contacts, const BodyRows<Real>& bodies,
               PassSettings<Real> pass) {
        const std::size_t hits = impacts_.swept_pairs();
        const bool rubs = has_friction_ && world.contacts.restitution.empty();
        const bool settles =
            world.joints.size() == 0 && (!rubs || hits * hits * hits <= kImpactWork);
        const std::size_t most = settles ? kImpactWork / hits : 0;
        change_ = std::numeric_limits<Real>::infinity();
        for (std::size_t done = kImpactSweeps;; done += kImpactSweeps) {
            sweep(contacts, bodies, pass, kImpactSweeps - 1);
            note_velocities(bodies);
            sweep(contacts, bodies, pass, 1);
            if (!goes_on(world, bodies, done) || done >= most) return;
        }
    }

    void sweep(Contacts& contacts, const BodyRows<Real>& bodies, PassSettings<Real> pass,
               std::size_t count) {
        workers_.run([&](std::uint32_t worker) {
            PassSettings<Real> mine = pass;
            for (std::size_t i = 0; i < count; ++i) {
                mine.forwards = (count - i) % 2 == 0;
                contacts.iterate_impacts(bodies, mine, worker);
            }
        });
    }

    template <class Visit>
    void each_swept(Visit visit) const {
        for (std::size_t i = 0; i < impacts_.colliding().size(); ++i)
            if (!impacts_.is_left(i)) visit(i);
    }

    void note_velocities(const BodyRows<Real>& bodies) {
        each_swept([&](std::size_t island) {
            impacts_.each_row(
                island, [&](std::int32_t row) { before_[row] = velocity_in(bodies.change, row); });
        });
    }

    /// Whether islands are swept on: their velocities have changed in the last sweep, and from one
    /// look at that to another by less, for what moving bodies jam never settles.
    bool goes_on(const World& world, const BodyRows<Real>& bodies, std::size_t done) {
        Real most = 0;
        each_swept([&](std::size_t island) {
            Real change = 0, greatest = 0;
            impacts_.each_row(island, [&](std::int32_t row) {
                const Velocity<Real> now = velocity_in(bodies.change, row);
                change = std::max(change, (now.v - before_[row].v).squaredNorm());
                greatest = std::max(greatest, now.v.squaredNorm());
            });
            if (!(change > static_cast<Real>(kImpactSettled * kImpactSettled) * greatest)) return;
            if (is_solvable(world, island))
                impacts_.leave(island);
            else
                most = std::max(most, change);
        });
        if (!(most > 0)) return false;
        if (done % kImpactLook != 0) return true;
        return most < std::exchange(change_, most) / 4;
    }

    bool is_solvable(const World& world, std::size_t island) const {
        const ContactIsland& from = impacts_.colliding()[island];
        return from.last_body - from.first_body <= most_exact_ && world.joints.size() == 0;
    }

    Workers& workers_;
    bool has_friction_;
    std::uint32_t most_exact_;  // bodies of an island that is solved exactly
    std::vector<BodyPair> pairs_;
    std::size_t swept_ = 0;  // of the pairs: they have rows
    Impacts impacts_;
    ExactImpacts exact_;
    std::vector<Velocity<Real>> before_;  // [row] the last sweep
    Real change_ = 0;                     // of velocities when last looked at, squared
};

}  // namespace plumb
