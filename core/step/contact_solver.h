// SPDX-License-Identifier: MIT
/// Contacts of one precision and lane width: from the world's columns to rows, iterations, and
/// back.
#pragma once

#include "contacts/anchors.h"
#include "contacts/contact_measures.h"
#include "contacts/contact_pairs.h"
#include "contacts/contact_sums.h"
#include "contacts/impacts.h"
#include "effects/plan.h"
#include "islands/island_account.h"
#include "islands/island_group.h"
#include "kernels/contact_kernels.h"
#include "schedule/contact_batches.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/contact_iteration.h"
#include "solve/contact_residuals.h"
#include "solve/mass_table.h"
#include "solve/velocity_table.h"
#include "step/contact_impacts.h"
#include "step/contact_impulses.h"
#include "step/row_work.h"
#include "world/world.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <tuple>
#include <vector>

namespace plumb {

/// The variant of rows that a plan calls for.
inline ContactVariant contact_variant(const Plan& plan) {
    if (plan.runs(Effect::turning_friction)) return ContactVariant::rolling;
    return plan.runs(Effect::friction) ? ContactVariant::friction : ContactVariant::frictionless;
}

template <class Real, int W>
class ContactSolver final : public ConstraintGroup<Real> {
public:
    ContactSolver(const Plan& plan, Workers& workers)
        : variant_(contact_variant(plan)),
          has_friction_(plan.runs(Effect::friction)),
          kernels_(contact_kernels<Real, W>(variant_)),
          workers_(workers) {}

    Stage stage() const override { return Stage::positions; }
    bool empty() const override { return pairs_.empty(); }
    const std::vector<BodyPair>& pairs() const { return pairs_; }

    /// Rows for the pairs; `levels` (may be null) makes the lower body of a pair immovable.
    /// `exact` (may be null) takes those that it solves, `take` after it.
    template <class Take>
    void load(const World& world, const std::vector<std::uint32_t>* levels, IslandGroup* exact,
              Take take) {
        levels_ = levels;
        find_pairs(world, levels, pairs_);
        if (exact) exact->load(world, pairs_);
        take(pairs_);
        lay_out(world);
        trusted_.resize(pairs_.size());
        const double fall = fall_in_step(world.settings);
        const double where_free = world.joints.size() == 0 ? kTrusted : kOutOfReach;
        const bool is_loose = world.joints.size() == 0 && world.particles.size() == 0;
        has_bounds_ = is_loose && world.kinematic_count > 0;
        greatest_.assign(has_bounds_ ? pairs_.size() : 0, kOutOfReach);
        const double weight = has_bounds_ ? weight_of_all(world) : 0;
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const BodyPair& pair = pairs_[i];
            const bool driven = is_driven(world, exact, pair);
            if (driven && has_bounds_) greatest_[i] = greatest_impulse(world, pair, weight);
            const double share = driven ? kTrustedWhereDriven : where_free;
            const double radius = smaller_radius(world.bodies, world.contacts.found[pair.first]);
            trusted_[i] = std::max(share * radius, fall);
        }
        fill_rows(world, [&](std::size_t p) {
            fill_surface(world, p);
            fill_arms(world, p);
        });
        is_fresh_ = true;
    }

    /// Impulses that the contacts remember of the step before. `exact` as in `load`: of an island
    /// that was solved exactly and comes back to the iterations, it says which contacts go on.
    void load_impulses(const World& world, const IslandGroup* exact) {
        const ContactArrays<Real, W> rows = batches_.arrays();
        each_contact([&](std::size_t contact, std::uint32_t k, std::uint32_t lane) {
            const ContactMemory& memory = world.contacts.memory[contact];
            if (!memory.matched) return;
            if (memory.exact &&
                !(exact && exact->choice().goes_on(world, static_cast<std::uint32_t>(contact))))
                return;
            rows.normals[k].lambda_velocity[lane] = static_cast<Real>(memory.normal_impulse);
            if (!rows.frictions) return;
            FrictionRow<Real, W>& across = rows.frictions[k];
            const auto [x, y] = tangents_of(rows.normals[k], across, lane);
            across.lambda_velocity_x[lane] = static_cast<Real>(x.dot(memory.friction_impulse));
            across.lambda_velocity_y[lane] = static_cast<Real>(y.dot(memory.friction_impulse));
        });
    }

    /// Overlaps deeper than the substep may push out.
    std::uint32_t clamped() const { return clamped_; }

    /// Arms, masses, gaps, restitution and anchor slip of the substep; sums of the pass before
    /// become the start of this one.
    void begin(const World& world, const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
               double) override {
        clamped_ = 0;
        std::atomic<std::uint32_t> clamped = 0;
        deep_.assign(pairs_.size(), 0);
        if (pairs_.empty()) return;
        if (!is_fresh_) move_geometry(world);
        is_fresh_ = false;
        const ContactTable& c = world.contacts;
        const ContactArrays<Real, W> rows = batches_.arrays();
        const double pull = world.settings.anchor_stiffness / static_cast<double>(pass.h);
        batches_.each_contact(pairs_, workers_, [&](const ContactPlace& at) {
            const auto [contact, k, lane] = std::tuple(at.contact, at.row, at.lane);
            NormalRow<Real, W>& row = rows.normals[k];
            if (has_bounds_) bound_impulses(rows, k, lane, greatest_[at.pair]);
            const double gap = gap_to_solve_for(world, contact, pass.recovery);
            row.gap[lane] = static_cast<Real>(gap);
            row.restitution_velocity[lane] = static_cast<Real>(restitution_velocity_of(c, contact));
            if (is_clamped(c.gap[contact], gap, pass.recovery)) ++clamped;
            if (-c.gap[contact] > trusted_[at.pair]) {
                damp_impulses(rows, k, lane, -c.gap[contact] / trusted_[at.pair]);
                deep_[at.pair] = 1;
            }
            if (!rows.frictions || c.anchor_slip.empty()) return;
            FrictionRow<Real, W>& across = rows.frictions[k];
            const auto [x, y] = tangents_of(row, across, lane);
            across.anchor_velocity_x[lane] =
                static_cast<Real>(pull * x.dot(c.anchor_slip[contact]));
            across.anchor_velocity_y[lane] =
                static_cast<Real>(pull * y.dot(c.anchor_slip[contact]));
        });
        clamped_ = clamped;
        run(kernels_.begin, bodies, pass);
        bend(c);
    }

    /// Memory for impacts among so many contacts, so that the first of them allocates none.
    void reserve_impacts(std::size_t contacts) { impacts_.reserve(batches_, contacts); }

    /// What an impact does to the rows is said in step/contact_impacts.h.
    void begin_impacts(const World& world, const Impacts& impacts, const BodyRows<Real>& bodies,
                       const PassSettings<Real>& pass) {
        if (!is_fresh_) move_geometry(world);
        is_fresh_ = true;
        impacts_.begin(world.contacts, impacts, pairs_, batches_);
        workers_.run([&](std::uint32_t worker) {
            iterate_ranges(kernels_.begin, batches_.arrays(), impacts_.blocks(), bodies, pass,
                           workers_, worker);
        });
    }
    void iterate_impacts(const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                         std::uint32_t worker) {
        iterate_ranges(kernels_.solve_velocities, batches_.arrays(), impacts_.blocks(), bodies,
                       pass, workers_, worker);
    }
    bool give_back(World& world, const Impacts& impacts, const BodyRows<Real>& bodies) {
        return impacts_.give_back(world, impacts, pairs_, batches_, bodies);
    }
    void end_impacts(World& world) { impacts_.end(world, batches_); }

    /// What the contacts of impacts bore, before their end: calls visit(island, contact, impulse).
    template <class Visit>
    void each_impact(const Impacts& impacts, Visit visit) {
        impacts.each_swept([&](std::size_t island, std::size_t pair) {
            each_place(pair, [&](const ContactPlace& at) {
                visit(island, at.contact, impulse_of(batches_.arrays(), at.row, at.lane));
            });
        });
    }

    /// Whether a contact of a pair overlaps by more than its impulses can be trusted with.
    bool is_deep(std::size_t pair) const { return deep_[pair] != 0; }

    /// The work of a pair's contacts; parameters as in step/row_work.h.
    void add_pair_work(ContactWork& work, std::size_t pair, const BodyRows<Real>& bodies,
                       const PushOut& push_out, double h) {
        each_place(pair, [&](const ContactPlace& at) {
            add_work(work, batches_.arrays(), at, bodies, push_out, h);
        });
    }
    /// Keeps a share of a pair's impulses.
    void scale_impulses(std::size_t pair, double share) {
        each_place(pair, [&](const ContactPlace& at) {
            each_sum(batches_.arrays(), at.row,
                     [&](Real* sum) { sum[at.lane] *= static_cast<Real>(share); });
        });
    }

    void warm_start(const BodyRows<Real>& bodies, const PassSettings<Real>& pass) override {
        run(kernels_.warm_start, bodies, pass);
    }
    void iterate_velocities(const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                            std::uint32_t worker) override {
        iterate(kernels_.solve_velocities, bodies, pass, worker);
    }
    void iterate_positions(const BodyRows<Real>& bodies, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        iterate(kernels_.solve_positions, bodies, pass, worker);
    }

    bool has_residuals() const override { return !pairs_.empty(); }
    void add_rows(std::vector<BodyPair>& pairs) const override {
        pairs.insert(pairs.end(), pairs_.begin(), pairs_.end());
    }
    void add_residuals(IslandResiduals& islands, const World&, const BodyRows<Real>& bodies,
                       const PassSettings<Real>& pass) override {
        residuals_.add_to(islands, batches_, pairs_, kernels_.find_residuals, bodies, pass,
                          workers_);
    }

    /// One iteration in which each batch is solved `rounds` times before the next.
    void rounds_iteration(const BodyRows<Real>& bodies, PassSettings<Real> pass,
                          std::uint32_t rounds, std::uint32_t worker) {
        const ContactArrays<Real, W> rows = batches_.arrays();
        for (const BlockRange& range : batches_.ranges())
            for (std::uint32_t r = 0; r < rounds; ++r) {
                pass.forwards = !pass.forwards;
                solve_batch(kernels_.solve_positions, rows, bodies, pass, range, workers_, worker);
            }
    }

    /// A contact that its impulses could not keep from a deep overlap is squeezed by more than they
    /// can hold: they would grow with every substep, and fly apart where they act askew. `overlap`:
    /// over the trusted one.
    static void damp_impulses(const ContactArrays<Real, W>& rows, std::uint32_t k,
                              std::uint32_t lane, double overlap) {
        const Real kept = static_cast<Real>(std::max(kLeastKept, 2 - overlap));
        each_sum(rows, k, [&](Real* sum) { sum[lane] *= kept; });
    }

    /// What is moved by others and jams a body between them makes impulses that only cancel each
    /// other, and grow with every substep until the least difference of their arms flings the body
    /// out. `greatest` [N s].
    static void bound_impulses(const ContactArrays<Real, W>& rows, std::uint32_t k,
                               std::uint32_t lane, double greatest) {
        const NormalRow<Real, W>& row = rows.normals[k];
        const double sum = double(row.lambda_velocity[lane]) + double(row.lambda_position[lane]);
        if (!(sum > greatest)) return;
        const Real kept = static_cast<Real>(greatest / sum);
        each_sum(rows, k, [&](Real* part) { part[lane] *= kept; });
    }

    /// Takes over another solver's summed impulses: what shock propagation adds to.
    void copy_impulses(ContactSolver& from) {
        const ContactArrays<Real, W> rows = batches_.arrays(), source = from.batches_.arrays();
        for (std::size_t p = 0; p < pairs_.size(); ++p) {
            const auto to = batches_.slot(p), at = from.batches_.slot(p);
            for (std::uint32_t i = 0; i < pairs_[p].count; ++i)
                copy_row(rows, row_of(to.block, i), to.lane, source, from.row_of(at.block, i),
                         at.lane);
        }
    }

    /// Adds what the contacts bear in this substep.
    void add_impulses(ContactSums& sums) {
        const ContactArrays<Real, W> rows = batches_.arrays();
        each_contact([&](std::size_t contact, std::uint32_t k, std::uint32_t lane) {
            const RowImpulse p = impulse_of(rows, k, lane);
            sums.add(contact, p.normal, p.friction());
        });
    }

    void end_step(World& world) override {
        const ContactArrays<Real, W> rows = batches_.arrays();
        each_contact([&](std::size_t contact, std::uint32_t k, std::uint32_t lane) {
            ContactMemory& memory = world.contacts.memory[contact];
            const RowImpulse p = impulse_of(rows, k, lane);
            remember_impulse(memory, p.normal, p.friction());
            memory.missed = missed_after_sweeps(memory.missed, world.steps);
            if (!rows.frictions) return;
            memory.sticks = does_stick(p.normal, p.x * p.x + p.y * p.y,
                                       double(rows.frictions[k].friction[lane]));
        });
    }

private:
    /// Overlap, as a share of the smaller body's radius, up to which impulses are carried over in
    /// full, if it is more than what gravity moves in a step. Only bodies that are moved by others
    /// squeeze without end; elsewhere it must be deep indeed, or heaps would creep. What presses on
    /// joints opens those, and its contacts come deep for a while: they are carried over whole.
    static constexpr double kTrusted = 0.2, kTrustedWhereDriven = 0.02;
    /// What is carried over at the least: sums stay bounded, and what is deep still finds out.
    static constexpr double kLeastKept = 0.8;

    /// What a contact that others squeeze may carry over is the weight of all and so many times
    /// what pushes its bodies out at Settings::recovery_speed.
    static constexpr double kGreatest = 10;
    static double greatest_impulse(const World& world, const BodyPair& pair, double weight) {
        const Contact& c = world.contacts.found[pair.first];
        const double mass = world.bodies.mass[c.a] + world.bodies.mass[c.b];
        return weight * substep_of(world.settings) +
               kGreatest * mass * world.settings.recovery_speed;
    }
    static double weight_of_all(const World& world) {
        double weight = 0;
        for (std::uint32_t i = 0; i < world.bodies.size(); ++i)
            weight += world.bodies.mass[i] * pull_on(world, i);
        return weight;
    }

    /// Whether what is moved by others may squeeze a pair. Without islands, and through
    /// deformables, it may anywhere.
    static bool is_driven(const World& world, const IslandGroup* exact, const BodyPair& pair) {
        if (world.kinematic_count == 0) return false;
        if (!exact || world.particles.size() > 0) return true;
        return exact->choice().is_driven(pair.row_a < world.dynamic_count ? pair.row_a
                                                                          : pair.row_b);
    }

    std::uint32_t row_of(std::uint32_t block, std::uint32_t point) {
        return batches_.arrays().blocks[block].first_row + point;
    }

    /// Calls visit(contact, row, lane) for all contacts, on all workers.
    template <class Visit>
    void each_contact(Visit visit) {
        batches_.each_contact(pairs_, workers_,
                              [&](const ContactPlace& at) { visit(at.contact, at.row, at.lane); });
    }

    /// Calls visit(ContactPlace) for the contacts of a pair.
    template <class Visit>
    void each_place(std::size_t pair, Visit visit) {
        batches_.each_contact(pairs_, pair, visit);
    }

    /// Velocities at contacts are those over the whole substep.
    void bend(const ContactTable& c) {
        if (c.bend.empty()) return;
        const ContactArrays<Real, W> rows = batches_.arrays();
        each_contact([&](std::size_t contact, std::uint32_t k, std::uint32_t lane) {
            if (c.bend[contact].isZero(0)) return;
            NormalRow<Real, W>& row = rows.normals[k];
            row.velocity[lane] +=
                static_cast<Real>(to_eigen(c.found[contact].normal).dot(c.bend[contact]));
            if (!rows.frictions) return;
            FrictionRow<Real, W>& across = rows.frictions[k];
            const auto [x, y] = tangents_of(row, across, lane);
            across.velocity_x[lane] += static_cast<Real>(x.dot(c.bend[contact]));
            across.velocity_y[lane] += static_cast<Real>(y.dot(c.bend[contact]));
        });
    }

    /// Gives the pairs their places among the rows: those that they have where the same bodies
    /// touch in as many points as in the step before.
    void lay_out(const World& world) {
        const auto is_alike = [](const BodyPair& x, const BodyPair& y) {
            return rows_of(x) == rows_of(y) && x.count == y.count && x.level == y.level;
        };
        const std::array<std::int32_t, 2> rows{world.moving_count(), world.zero_row()};
        if (rows == laid_out_rows_ &&
            std::equal(pairs_.begin(), pairs_.end(), laid_out_.begin(), laid_out_.end(), is_alike))
            return batches_.clear_rows();
        laid_out_.reserve(pairs_.capacity());
        laid_out_ = pairs_, laid_out_rows_ = rows;
        colouring_.colour(pairs_, world.moving_count());
        batches_.lay_out(pairs_, colouring_, variant_, world.zero_row());
    }

    /// Fills the rows of all pairs by fill(pair), their masses, and what follows from both.
    template <class Fill>
    void fill_rows(const World& world, Fill fill) {
        if (pairs_.empty()) return;
        masses_.fill(world);
        workers_.run([&](std::uint32_t worker) {
            const Range blocks = workers_.share(batches_.block_count(), worker);
            kernels_.take_masses(batches_.arrays(), masses_.rows(), blocks.first, blocks.last);
        });
        batches_.each_pair(workers_, fill);
        if (levels_) hold_lower(world);
        run(kernels_.prepare, {}, {});
    }

    /// To the poses now.
    void move_geometry(const World& world) {
        fill_rows(world, [&](std::size_t p) { fill_arms(world, p); });
    }

    /// Makes the body of a pair immovable that is nearer to the ground.
    void hold_lower(const World& world) {
        const auto hold = [](Real(&mass)[W], Real(&inertia)[6][W], std::uint32_t lane) {
            mass[lane] = 0;
            for (auto& entry : inertia) entry[lane] = 0;
        };
        for (std::size_t p = 0; p < pairs_.size(); ++p) {
            const auto [at, lane] = batches_.slot(p);
            const Contact& first = world.contacts.found[pairs_[p].first];
            const std::uint32_t a = (*levels_)[first.a], b = (*levels_)[first.b];
            PairBlock<Real, W>& block = batches_.arrays().blocks[at];
            if (a < b) hold(block.inverse_mass_a, block.inverse_inertia_a, lane);
            if (b < a) hold(block.inverse_mass_b, block.inverse_inertia_b, lane);
        }
    }

    /// From the bodies of a pair to its contacts.
    void fill_arms(const World& world, std::size_t p) {
        const ContactArrays<Real, W> rows = batches_.arrays();
        const Contact& first = world.contacts.found[pairs_[p].first];
        const Vector3d &at_a = world.bodies.position[first.a],
                       &at_b = world.bodies.position[first.b];
        each_place(p, [&](const ContactPlace& at) {
            const Vector3d& point = world.contacts.point[at.contact];
            const Vector3d arm_a = point - at_a, arm_b = point - at_b;
            NormalRow<Real, W>& row = rows.normals[at.row];
            for (int i = 0; i < 3; ++i) {
                row.arm_a[i][at.lane] = static_cast<Real>(arm_a[i]);
                row.arm_b[i][at.lane] = static_cast<Real>(arm_b[i]);
            }
        });
    }

    /// What the rows of a pair keep through all substeps.
    void fill_surface(const World& world, std::size_t p) {
        const ContactArrays<Real, W> rows = batches_.arrays();
        const Contact& first = world.contacts.found[pairs_[p].first];
        const SurfacePair& surface = world.surface_pair(first.a, first.b);
        each_place(p, [&](const ContactPlace& at) {
            const auto [contact, k, lane] = std::tuple(at.contact, at.row, at.lane);
            const Vec3& n = world.contacts.found[contact].normal;
            const double normal[3] = {n.x, n.y, n.z};
            for (int i = 0; i < 3; ++i)
                rows.normals[k].normal[i][lane] = static_cast<Real>(normal[i]);
            if (rows.frictions)
                rows.frictions[k].friction[lane] =
                    static_cast<Real>(has_friction_ ? surface.friction : 0);
            if (!rows.rollings) return;
            rows.rollings[k].rolling[lane] = static_cast<Real>(surface.rolling_friction);
            rows.rollings[k].spinning[lane] = static_cast<Real>(surface.spinning_friction);
        });
    }

    static void copy_row(const ContactArrays<Real, W>& to, std::uint32_t k, std::uint32_t lane,
                         const ContactArrays<Real, W>& from, std::uint32_t j,
                         std::uint32_t from_lane) {
        const NormalRow<Real, W>& source = from.normals[j];
        to.normals[k].lambda_velocity[lane] =
            source.lambda_velocity[from_lane] + source.lambda_position[from_lane];
        to.normals[k].lambda_position[lane] = 0;
        if (!to.frictions) return;
        const FrictionRow<Real, W>& across = from.frictions[j];
        to.frictions[k].lambda_velocity_x[lane] =
            across.lambda_velocity_x[from_lane] + across.lambda_position_x[from_lane];
        to.frictions[k].lambda_velocity_y[lane] =
            across.lambda_velocity_y[from_lane] + across.lambda_position_y[from_lane];
        to.frictions[k].lambda_position_x[lane] = to.frictions[k].lambda_position_y[lane] = 0;
    }

    /// Runs a kernel over all blocks in one go each batch, all workers together.
    void run(ContactPass<Real, W> kernel, const BodyRows<Real>& bodies,
             const PassSettings<Real>& pass) {
        workers_.run([&](std::uint32_t worker) { iterate(kernel, bodies, pass, worker); });
    }

    void iterate(ContactPass<Real, W> kernel, const BodyRows<Real>& bodies,
                 const PassSettings<Real>& pass, std::uint32_t worker) {
        iterate_batches(kernel, batches_, bodies, pass, workers_, worker);
    }

    ContactVariant variant_;
    bool has_friction_;  // rows that resist rolling have room for friction, too, where it is
                         // forbidden
    const ContactKernels<Real, W>& kernels_;
    Workers& workers_;
    std::vector<BodyPair> pairs_, laid_out_;
    std::array<std::int32_t, 2> laid_out_rows_{-1, -1};  // that change, and the one of zeros
    Colouring colouring_;
    ContactBatches<Real, W> batches_;
    MassTable<Real> masses_;
    ContactImpacts<Real, W> impacts_;
    ContactResiduals<Real, W> residuals_;
    std::vector<double> trusted_;     // [pair] overlap [m]
    bool has_bounds_ = false;         // whether any is below kOutOfReach
    std::vector<double> greatest_;    // [pair], see greatest_impulse [N s]
    std::vector<std::uint8_t> deep_;  // [pair]
    const std::vector<std::uint32_t>* levels_ = nullptr;
    std::uint32_t clamped_ = 0;
    bool is_fresh_ = false;  ///< whether arms and masses are those of the substep that begins
};

}  // namespace plumb
