// SPDX-License-Identifier: MIT
/// Sees to it that iterations of contacts, and joints that are iterated or solved among them, give
/// an island no more energy than it may have (solve/energy_loan.h). Rows at the preview poses say
/// little of the way there where links whip round by radians within a substep, and contacts have
/// the last word over joints, which they open and which close again: a few iterations may end at
/// rates from which the next substep does not recover.
#pragma once

#include "schedule/contact_islands.h"
#include "solve/energy_loan.h"
#include "solve/island_residuals.h"
#include "step/contact_solver.h"
#include "step/keep_share.h"
#include "world/tie.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plumb {

template <class Real, int W>
class JointEnergyBound {
public:
    explicit JointEnergyBound(const World& world) : is_joined_(world.bodies.size(), 0) {
        for (const Joint& joint : world.joints.joints)
            for (const std::uint32_t body : {joint.a, joint.b})
                if (body != kNoIndex) is_joined_[body] = 1;
        for (const std::uint32_t body : world.body_of_row)
            if (is_joined_[body]) joined_.push_back(body);
        ties_.reserve(world.joints.size() + world.links.size());
        loans_.reserve(world.body_of_row.size());
    }

    /// After the passes of a substep of h [s]; bodies: their rows.
    void apply(World& world, ContactSolver<Real, W>& contacts, const BodyRows<Real>& bodies,
               double h) {
        if (!any_touches(world, contacts.pairs()) && !any_whirls(world.bodies, bodies, h)) return;
        ties_.clear();
        add_tied_rows(world, ties_);
        islands_.find(contacts.pairs(), ties_, 0, world.dynamic_count);
        find_loans(world, contacts.pairs(), bodies, h);
        for (std::size_t i = 0; i < loans_.size(); ++i) {
            Account& account = loans_[i];
            if (account.joints == 0 || account.is_driven) continue;
            const double share = account.loan.share();
            if (share < 1) keep_share(share, islands_, islands_.islands()[i], contacts, bodies);
            account.loan.owed = account.loan.owed_after(account.loan.gained_with(share));
        }
        for (Joint& joint : world.joints.joints)
            if (const Account* account = account_of(world, joint))
                joint.owed = account->is_driven ? 0 : account->loan.owed / account->joints;
    }

private:
    /// Of an island.
    struct Account {
        EnergyLoan loan;
        std::uint32_t joints = 0;
        bool is_driven = false;  ///< by others, or by what gives whatever it takes
    };

    bool any_touches(const World& world, const std::vector<BodyPair>& pairs) const {
        return std::any_of(pairs.begin(), pairs.end(), [&](const BodyPair& pair) {
            const Contact& first = world.contacts.found[pair.first];
            return is_joined_[first.a] || is_joined_[first.b];
        });
    }

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

    void find_loans(const World& world, const std::vector<BodyPair>& pairs,
                    const BodyRows<Real>& rows, double h) {
        const Bodies& b = world.bodies;
        loans_.assign(islands_.islands().size(), Account{});
        for (const std::int32_t row : islands_.bodies()) {
            const std::uint32_t i = world.body_of_row[static_cast<std::size_t>(row)];
            const Velocity<double> x = change_of(b, rows, i);
            EnergyLoan& loan = loans_[islands_.island_of()[static_cast<std::size_t>(row)]].loan;
            loan.add_change(b, i, b.velocity[i], b.angular_velocity[i], x.v, x.w);
        }
        for (const BodyPair& pair : pairs) {
            const Contact& first = world.contacts.found[pair.first];
            const std::uint32_t body = b.motion[first.a] == Motion::dynamic ? first.a : first.b;
            Account* account = account_of(world, body);
            if (!account) continue;
            double overlap = 0;
            for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
                overlap = std::max(overlap, -world.contacts.gap[k]);
            account->loan.add_overlap(world, first, overlap, h);
            account->is_driven |= moves_by_itself(b, first.a) || moves_by_itself(b, first.b);
        }
        for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
            const Joint& joint = world.joints.joints[i];
            Account* account = account_of(world, joint);
            if (!account) continue;
            ++account->joints;
            account->loan.add_joint(world, i, h);
            account->is_driven |= moves_by_itself(b, joint.a) || moves_by_itself(b, joint.b);
        }
        const auto leave_out = [&](std::uint32_t body) { exclude(world, body); };
        for (std::uint32_t i = 0; i < world.joints.couplings.size(); ++i)
            each_body(world, {TieKind::coupling, i}, leave_out);
        world.each_linked_body(true, leave_out);
        world.each_body_among_particles(leave_out);
    }

    Account* account_of(const World& world, std::uint32_t body) {
        if (body == kNoIndex || world.bodies.motion[body] != Motion::dynamic) return nullptr;
        const std::uint32_t island = islands_.island_of()[world.bodies.row[body]];
        return island < loans_.size() ? &loans_[island] : nullptr;
    }
    Account* account_of(const World& world, const Joint& joint) {
        if (!world.acts(joint)) return nullptr;
        Account* account = account_of(world, joint.a);
        return account ? account : account_of(world, joint.b);
    }

    /// What others move, or something drives, may gain whatever they give.
    void exclude(const World& world, std::uint32_t body) {
        if (Account* account = account_of(world, body)) account->is_driven = true;
    }

    std::vector<std::uint8_t> is_joined_;  // [body] whether a joint holds it
    std::vector<std::uint32_t> joined_;    // those of them that are dynamic
    std::vector<BodyPair> ties_;
    ContactIslands islands_;
    std::vector<Account> loans_;  // [island]
};

}  // namespace plumb
