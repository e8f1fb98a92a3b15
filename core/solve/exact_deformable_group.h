// SPDX-License-Identifier: MIT
/// All that holds deformables together, their contacts and links, and contacts and ties of the
/// bodies that touch them, solved as one system. Other bodies stay with the iterations, in turn
/// with it.
#pragma once

#include "contacts/contact_sums.h"
#include "effects/plan.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/elastic_system.h"
#include "solve/momentum_keeper.h"
#include "solve/particle_rows.h"
#include "solve/triangle_couple.h"

#include <vector>

namespace plumb {

template <class Real>
class ExactDeformableGroup final : public ConstraintGroup<Real> {
public:
    ExactDeformableGroup(const World& world, const Plan& plan, Workers& workers)
        : workers_(workers),
          system_(world, plan),
          mass_(world.particles),
          keeper_(world, mass_, workers) {
        velocity_.resize(world.particles.size());
    }

    Stage stage() const override { return Stage::particles; }
    bool empty() const override { return velocity_.empty(); }

    /// Once a step: removes from `pairs` (of bodies) those that it solves, and marks such ties.
    void take(const World& world, std::vector<BodyPair>& pairs, SolvedTies& solved) {
        system_.load(world, pairs);
        system_.ties().mark(solved);
        couples_.reserve(system_.contacts().contacts().capacity());
        touches_.assign(velocity_.size(), 0);
        for (const ElasticContacts::Contact& c : system_.contacts().contacts())
            if (!c.is_between_particles() && c.sides[1].body == kNoIndex)
                for (std::uint32_t k = 0; k < c.points; ++k) touches_[c.particle[k]] = 1;
        keeper_.leave(touches_);
        system_.load_pieces(keeper_.pieces());  // those that were not left
    }

    void begin(const World& world, const BodyRows<Real>&, const PassSettings<Real>& pass,
               double h) override {
        first_row_ = world.particle_row(0);
        keeper_.begin(world);
        system_.begin(world, h, double(pass.stiffness), double(pass.recovery));
        couples_.clear();
        for (const ElasticContacts::Contact& c : system_.contacts().contacts())
            couples_.push_back(
                c.is_between_particles()
                    ? TriangleCouple(world.particles, world.surface_contacts[c.source])
                    : TriangleCouple());
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>&,
                           std::uint32_t worker) override {
        if (worker == 0) solve(rows);
        workers_.barrier();
        keeper_.note(rows, worker);
        if (worker == 0) take_velocities(rows);
        workers_.barrier();
        keeper_.restore(rows, worker);
    }

    /// Adds what the contacts bear in this substep.
    void add_impulses(ContactSums& sums) const {
        using Source = ElasticContacts::Source;
        for (const ElasticContacts::Contact& c : system_.contacts().contacts()) {
            if (c.of == Source::surface) continue;
            if (c.of == Source::bodies)
                sums.add(c.source, c.applied_along(), c.applied_across());
            else
                sums.add_of_particle(c.source, c.applied_along(), c.applied_across());
        }
    }

    void end_substep(World& world) override { system_.store_ties(world); }
    void end_step(World& world) override { system_.store(world); }

private:
    /// Contacts push both sides at once; what elements do, which momentum must not feel, comes
    /// after.
    void solve(const BodyRows<Real>& rows) {
        ElasticContacts& contacts = system_.contacts();
        std::vector<ElasticContacts::Body>& bodies = contacts.bodies();
        for (std::size_t i = 0; i < velocity_.size(); ++i)
            velocity_[i] = velocity_of(rows, row(i)).v;
        for (ElasticContacts::Body& body : bodies) body.v = velocity_of(rows, body.table_row);
        system_.solve(velocity_, keeper_.pieces());
        for (std::size_t n = 0; n < couples_.size(); ++n) {
            ElasticContacts::Contact& c = contacts.contacts()[n];
            const Vector3d change = c.q - c.applied;
            c.applied = c.q;
            if (c.is_between_particles()) {
                const std::array<Vector3d, 3> turned = couples_[n].changes_by(change);
                for (std::uint32_t k = 0; k < 3; ++k)
                    add_change(rows, row(c.particle[k]), turned[k]);
            }
            for (std::uint32_t k = 0; k < c.points; ++k)
                add_change(rows, row(c.particle[k]),
                           Vector3d(change * (c.weight[k] * mass_.inverse[c.particle[k]])));
            for (int i = 0; i < 2; ++i) {
                const ElasticContacts::Side& side = c.sides[i];
                if (side.body == kNoIndex) continue;
                const ElasticContacts::Body& body = bodies[side.body];
                Velocity<double> moved{Vector3d::Zero(), Vector3d::Zero()};
                apply_impulse<double>(moved, body.inverse, side.arm,
                                      ElasticContacts::kSign[i] * change);
                add_change(rows, body.table_row, moved);
            }
        }
        ElasticTies& ties = system_.ties();
        for (std::size_t i = 0; i < ties.rows().size(); ++i) {
            const double change = ties.impulses()[i] - ties.applied()[i];
            ties.applied()[i] = ties.impulses()[i];
            for (const RowSide& side : ties.rows()[i].sides()) {
                const std::uint32_t point = ties.particle(side.body);
                if (point != kNoIndex) {
                    add_change(rows, row(point),
                               Vector3d(change * mass_.inverse[point] * side.on.head<3>()));
                    continue;
                }
                const ElasticContacts::Body& body = bodies[side.body];
                add_change(rows, body.table_row,
                           ElasticContacts::change_by(body, change * side.on));
            }
        }
    }

    void take_velocities(const BodyRows<Real>& rows) {
        for (std::size_t i = 0; i < velocity_.size(); ++i)
            add_change(rows, row(i), Vector3d(velocity_[i] - velocity_of(rows, row(i)).v));
    }

    std::int32_t row(std::size_t particle) const {
        return first_row_ + static_cast<std::int32_t>(particle);
    }

    Workers& workers_;
    ElasticSystem system_;
    ParticleMass mass_;
    MomentumKeeper<Real> keeper_;
    std::vector<Vector3d> velocity_;       ///< [particle] [m/s]
    std::vector<TriangleCouple> couples_;  ///< [contact], of those between particles
    std::vector<std::uint8_t> touches_;    ///< [particle] whether it touches what does not move
    std::int32_t first_row_ = 0;
};

}  // namespace plumb
