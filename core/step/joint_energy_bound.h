// SPDX-License-Identifier: MIT
/// Sees to it that iterations of joints and contacts add no more energy than what drives the joints
/// can give. Where links whip round by radians within a substep, rows at the preview poses say
/// little of the way there, and a few iterations may end at rates from which the next substep does
/// not recover. Where an island gains more, only a share of all that is changed of its velocities
/// is taken: that keeps the sums of momentum, and joints close later.
#pragma once

#include "contacts/contact_measures.h"
#include "schedule/contact_islands.h"
#include "solve/island_residuals.h"
#include "step/contact_solver.h"
#include "step/keep_share.h"
#include "ties/joint_state.h"
#include "ties/tie_work.h"
#include "world/body_momentum.h"
#include "world/tie.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumb {

template <class Real, int W>
class JointEnergyBound {
public:
    explicit JointEnergyBound(const World& world) : body_of_(world.dynamic_count) {
        std::vector<std::uint8_t> joined(world.bodies.size(), 0);
        for (const Joint& joint : world.joints.joints)
            for (const std::uint32_t body : {joint.a, joint.b})
                if (body != kNoIndex) joined[body] = 1;
        for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
            if (world.bodies.motion[i] != Motion::dynamic) continue;
            body_of_[static_cast<std::size_t>(world.bodies.row[i])] = i;
            if (joined[i]) joined_.push_back(i);
        }
        ties_.reserve(world.joints.size() + world.links.size());
        energies_.reserve(body_of_.size());
    }

    /// After the passes of a substep of h [s]; bodies: their rows.
    void apply(const World& world, ContactSolver<Real, W>& contacts, const BodyRows<Real>& bodies,
               const PushOut& push_out, double h) {
        if (!any_whirls(world.bodies, bodies, h)) return;
        ties_.clear();
        add_tied_rows(world, ties_);
        islands_.find(contacts.pairs(), ties_, 0, world.dynamic_count);
        find_energies(world, contacts.pairs(), bodies, push_out, h);
        for (std::size_t i = 0; i < energies_.size(); ++i) {
            const double share = energies_[i].share();
            if (share < 1) keep_share(share, islands_, islands_.islands()[i], contacts, bodies);
        }
    }

private:
    /// A share of its energy that what swings quickly may gain in a substep: bodies move along
    /// chords.
    static constexpr double kSwings = 0.1;

    /// Of an island [J]. With a share s of the changes of the substep it has at_start + linear s +
    /// square s².
    struct Energy {
        double at_start = 0, linear = 0, square = 0;
        double granted = 0;  ///< what drives give, and old errors that close
        bool is_driven = false;

        /// The greatest share of all changes with which it is no more than may be.
        double share() const {
            const double most = kSwings * at_start + granted;
            if (is_driven || !(linear + square > most)) return 1;
            const double root = std::sqrt(linear * linear + 4 * square * most);
            return std::clamp((root - linear) / (2 * square), 0.0, 1.0);
        }
    };

    bool any_whirls(const Bodies& b, const BodyRows<Real>& rows, double h) const {
        double fastest = 0;  // squared
        for (const std::uint32_t i : joined_) {
            const Vector3d rate = b.angular_velocity[i] + change_of(b, rows, i).w;
            fastest = std::max(fastest, rate.squaredNorm());
        }
        return h * h * fastest > kTrustedTurn * kTrustedTurn;
    }

    static Velocity<double> change_of(const Bodies& b, const BodyRows<Real>& rows,
                                      std::uint32_t body) {
        const Velocity<Real> x = velocity_in(rows.change, b.row[body]);
        return {x.v.template cast<double>(), x.w.template cast<double>()};
    }

    void find_energies(const World& world, const std::vector<BodyPair>& pairs,
                       const BodyRows<Real>& rows, const PushOut& push_out, double h) {
        const Bodies& b = world.bodies;
        energies_.assign(islands_.islands().size(), Energy{});
        for (const std::int32_t row : islands_.bodies()) {
            const std::uint32_t i = body_of_[static_cast<std::size_t>(row)];
            const Velocity<double> x = change_of(b, rows, i);
            const Vector3d &v = b.velocity[i], &w = b.angular_velocity[i];
            Energy& energy = energies_[islands_.island_of()[static_cast<std::size_t>(row)]];
            energy.at_start += kinetic_energy(b, i);
            energy.linear += b.mass[i] * v.dot(x.v) + inertia_product(b, i, w, x.w);
            energy.square += kinetic_energy(b, i, x.v, x.w);
        }
        const double recovery = world.settings.recovery_speed;
        for (const BodyPair& pair : pairs) {
            const Contact& first = world.contacts.found[pair.first];
            double overlap = 0;
            for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
                overlap = std::max(overlap, -world.contacts.gap[k]);
            const double speed = std::min(push_out.share * overlap / h, recovery);
            for (const std::uint32_t body : {first.a, first.b}) grant(world, body, speed);
            if (moves_by_itself(b, first.a)) exclude(world, first.b);
            if (moves_by_itself(b, first.b)) exclude(world, first.a);
        }
        for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
            const Joint& joint = world.joints.joints[i];
            if (!world.acts(joint)) continue;
            const bool is_moved = moves_by_itself(b, joint.a) || moves_by_itself(b, joint.b);
            const double work = most_work(world, i, h);
            for (const std::uint32_t body : {joint.a, joint.b}) {
                if (is_moved) exclude(world, body);
                if (body == kNoIndex) continue;
                const double open = std::max(joint_gap(b, joint),
                                             b.bounding_radius[body] * joint_turn_gap(b, joint));
                grant(world, body, std::min(open / h, recovery));
                if (Energy* energy = energy_of(world, body)) energy->granted += work;
            }
        }
        const auto leave_out = [&](std::uint32_t body) { exclude(world, body); };
        for (std::uint32_t i = 0; i < world.joints.couplings.size(); ++i)
            each_body(world, {TieKind::coupling, i}, leave_out);
        world.each_linked_body(true, leave_out);
        world.each_body_among_particles(leave_out);
    }

    Energy* energy_of(const World& world, std::uint32_t body) {
        if (body == kNoIndex || world.bodies.motion[body] != Motion::dynamic) return nullptr;
        const std::uint32_t island = islands_.island_of()[world.bodies.row[body]];
        return island < energies_.size() ? &energies_[island] : nullptr;
    }

    /// The energy of a body at the speed at which an error closes.
    void grant(const World& world, std::uint32_t body, double speed) {
        if (Energy* energy = energy_of(world, body))
            energy->granted += 0.5 * world.bodies.mass[body] * speed * speed;
    }

    /// What others move, or something drives, may gain whatever they give.
    void exclude(const World& world, std::uint32_t body) {
        if (Energy* energy = energy_of(world, body)) energy->is_driven = true;
    }

    std::vector<std::uint32_t> body_of_;  // [dynamic row]
    std::vector<std::uint32_t> joined_;   // dynamic bodies with a joint
    std::vector<BodyPair> ties_;
    ContactIslands islands_;
    std::vector<Energy> energies_;  // [island]
};

}  // namespace plumb
