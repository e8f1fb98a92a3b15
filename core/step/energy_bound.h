// SPDX-License-Identifier: MIT
/// Sees to it that iterations of contacts add no energy (contacts/contact_work.h): where those of
/// an island do, only a share of their impulses is taken, and remembered.
///
/// It looks at islands in which a body is fast, for what rests may converge as it likes, and one is
/// much heavier than another that it touches, or is moved by others; not at those that joints,
/// links or particles hold, whose impulses would have to follow.
#pragma once

#include "contacts/contact_work.h"
#include "schedule/contact_islands.h"
#include "step/contact_solver.h"
#include "step/keep_share.h"
#include "world/body_momentum.h"
#include "world/tie.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace plumb {

template <class Real, int W>
class EnergyBound {
public:
    /// Once a step, before the others.
    void load(const World& world, const std::vector<BodyPair>& pairs) {
        uneven_.clear(), watches_ = false;
        if (!may_be_uneven(world)) return;
        for (const BodyPair& pair : pairs) uneven_.push_back(is_uneven(world, pair));
        watches_ = std::count(uneven_.begin(), uneven_.end(), 1) > 0;
        found_ = false;
    }

    /// After the passes of a substep of h [s]; bodies: their rows.
    void apply(const World& world, ContactSolver<Real, W>& contacts, const BodyRows<Real>& bodies,
               const PushOut& push_out, double h) {
        if (!watches_ || !find_fast(world, bodies, resting_speed(world.settings, h))) return;
        if (!found_) find_islands(world, contacts.pairs());
        for (const ContactIsland& island : islands_.islands()) {
            if (!is_watched(island)) continue;
            ContactWork work;
            for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i)
                contacts.add_pair_work(work, islands_.pairs()[i], bodies, push_out, h);
            double share = 1;
            if (work.at_start + work.of_change > 0) share = work.share(most_granted(world, island));
            if (is_deep(contacts, island))
                share = std::min(share, share_without_flinging(world.settings, [&](auto visit) {
                                     each_change(world, bodies, island, visit);
                                 }));
            if (share < 1) keep_share(share, islands_, island, contacts, bodies);
        }
    }

private:
    /// Marks the dynamic bodies that move faster than the threshold [m/s]; whether any does.
    bool find_fast(const World& world, const BodyRows<Real>& rows, double threshold) {
        const Bodies& b = world.bodies;
        fast_.assign(static_cast<std::size_t>(world.dynamic_count), 0);
        bool any = false;
        for (std::size_t i = 0; i < b.size(); ++i) {
            if (b.motion[i] != Motion::dynamic) continue;
            const Velocity<Real> change = velocity_in(rows.change, b.row[i]);
            const Vector3d v = b.velocity[i] + change.v.template cast<double>(),
                           w = b.angular_velocity[i] + change.w.template cast<double>();
            const double radius = b.bounding_radius[i];
            const double square = v.squaredNorm() + radius * radius * w.squaredNorm();
            any |= fast_[b.row[i]] = square > threshold * threshold;
        }
        return any;
    }

    void find_islands(const World& world, const std::vector<BodyPair>& pairs) {
        found_ = true;
        islands_.find(pairs, {}, 0, world.dynamic_count);
        held_.assign(static_cast<std::size_t>(world.dynamic_count), 0);
        const auto hold = [&](std::uint32_t body) {
            if (body != kNoIndex && world.bodies.motion[body] == Motion::dynamic)
                held_[world.bodies.row[body]] = 1;
        };
        world.each_body_among_particles(hold);
        for (std::uint32_t i = 0; i < world.joints.size(); ++i)
            if (holds(world, {TieKind::joint, i})) each_body(world, {TieKind::joint, i}, hold);
        world.each_linked_body(true, hold);
    }

    /// Whether any two bodies could be.
    static bool may_be_uneven(const World& world) {
        if (world.kinematic_count > 0) return true;
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (const double mass : world.bodies.mass)
            if (mass > 0) least = std::min(least, mass), most = std::max(most, mass);
        return most > kUneven * least;
    }

    /// Whether one of two bodies is much heavier than the other, or is moved by others.
    static bool is_uneven(const World& world, const BodyPair& pair) {
        const Bodies& bodies = world.bodies;
        const Contact& c = world.contacts.found[pair.first];
        if (bodies.motion[c.a] == Motion::kinematic || bodies.motion[c.b] == Motion::kinematic)
            return true;
        return plumb::is_uneven(bodies, c);
    }

    bool is_watched(const ContactIsland& island) const {
        const auto first = islands_.pairs().begin();
        if (std::none_of(first + island.first_pair, first + island.last_pair,
                         [&](std::uint32_t pair) { return uneven_[pair] != 0; }))
            return false;
        bool fast = false;
        for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
            const std::int32_t row = islands_.bodies()[i];
            if (held_[row]) return false;
            fast |= fast_[row] != 0;
        }
        return fast;
    }

    bool is_deep(const ContactSolver<Real, W>& contacts, const ContactIsland& island) const {
        const auto first = islands_.pairs().begin();
        return std::any_of(first + island.first_pair, first + island.last_pair,
                           [&](std::uint32_t pair) { return contacts.is_deep(pair); });
    }

    /// Calls visit(velocity, change) for the bodies of an island.
    template <class Visit>
    void each_change(const World& world, const BodyRows<Real>& rows, const ContactIsland& island,
                     Visit visit) const {
        for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
            const std::int32_t row = islands_.bodies()[i];
            visit(world.bodies.velocity[world.body_of_row[row]],
                  Vector3d(velocity_in(rows.change, row).v.template cast<double>()));
        }
    }

    /// What may come of the overlap of an island at the most [J]: the energy of all its bodies at
    /// the speed of recovery, less what they have. What is wedged between surfaces that are all but
    /// parallel would leave many times as fast as those part.
    double most_granted(const World& world, const ContactIsland& island) const {
        const Bodies& b = world.bodies;
        const double speed = world.settings.recovery_speed;
        double energy = 0;
        for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
            const std::uint32_t body = world.body_of_row[islands_.bodies()[i]];
            energy += 0.5 * b.mass[body] * speed * speed - kinetic_energy(b, body);
        }
        return std::max(0.0, energy);
    }

    ContactIslands islands_;
    bool watches_ = false, found_ = false;
    std::vector<std::uint8_t> fast_, held_;  // [dynamic row]
    std::vector<std::uint8_t> uneven_;       // [pair]
};

}  // namespace plumb
