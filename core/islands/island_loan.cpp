// SPDX-License-Identifier: MIT
#include "islands/island_loan.h"

#include "solve/energy_loan.h"
#include "solve/rest_motion.h"
#include "ties/tie_work.h"

#include <algorithm>
#include <limits>

namespace plumb {
namespace {

/// With so large a share of its changes, what an island does not gain now comes back as its joints
/// close, and nothing is lost of a smooth motion.
constexpr double kNearlyAll = 0.9;

/// By how much of its velocities an island is braked at the most. What would have to lose more is
/// no motion that its joints lead to.
constexpr double kMostBraked = 0.1;

/// Unless a body turns farther than this within the substep [rad]: it does not turn as its joints
/// were solved for, and what it gains by that is not seen here.
constexpr double kWhirl = 0.2;

/// What its velocities have come to, and from what.
void add_changes(EnergyLoan& loan, const World& world, const IslandColumns& columns,
                 const ExactIsland& island) {
    const Bodies& b = world.bodies;
    for (std::uint32_t k = island.first_body; k < island.last_body; ++k) {
        const std::uint32_t i = columns.bodies[k].body;
        const Vector6d change = columns.velocity[k] - columns.start[k];
        loan.add_change(b, i, b.velocity[i], b.angular_velocity[i], change.head<3>(),
                        change.tail<3>());
    }
}

EnergyLoan loan_of(const World& world, const IslandColumns& columns, const ExactIsland& island) {
    const double h = columns.h;
    EnergyLoan loan;
    add_changes(loan, world, columns, island);
    for (const std::uint32_t i : points_in(columns.contacts, island))
        loan.add_overlap(world, world.contacts.found[i], -world.contacts.gap[i], h);
    columns.ties.each(island.ties, [&](const Tie& tie) {
        if (tie.kind == TieKind::joint)
            loan.add_joint(world, tie.index, h);
        else if (can_do_work(world, tie))
            loan.granted = std::numeric_limits<double>::infinity();
    });
    return loan;
}

bool whirls(const IslandColumns& columns, const ExactIsland& island) {
    const std::span<const Vector6d> velocities = bodies_in(columns.velocity, island);
    return std::any_of(velocities.begin(), velocities.end(),
                       [&](const Vector6d& v) { return columns.h * v.tail<3>().norm() > kWhirl; });
}

/// Returns whether that does.
bool brake(const World& world, const IslandColumns& columns, const Island& all, EnergyLoan loan,
           ExactIsland& island) {
    const Bodies& b = world.bodies;
    const RigidMotion rest = rest_of(b, island.flies, all.bodies, all.velocity);
    const std::span<const Vector6d> start = bodies_in(columns.start, island);
    for (std::size_t k = 0; k < start.size(); ++k) {
        const std::uint32_t i = all.bodies[k].body;
        const Vector6d change = all.velocity[k] - start[k];
        const Velocity<double> r = rest.of(b, i);
        loan.add_braking(b, i, b.velocity[i], b.angular_velocity[i], change.head<3>(),
                         change.tail<3>(),
                         {all.velocity[k].head<3>() - r.v, all.velocity[k].tail<3>() - r.w});
    }
    const double share = loan.brake();
    if (!(share <= kMostBraked) || whirls(columns, island)) return false;
    brake(b, rest, share, all.bodies, all.velocity);
    island.owed = loan.owed_after(loan.gained_braked(share));
    return true;
}

}  // namespace

void bound_gain(const World& world, IslandColumns& columns, ExactIsland& island) {
    island.owed = 0;
    if (island.ties.empty() || island.is_driven) return;
    const EnergyLoan loan = loan_of(world, columns, island);
    const double share = loan.share();
    island.owed = loan.owed_after(loan.gained_with(share));
    if (share == 1) return;
    const Island all = columns.all_of(island);
    if (share < kNearlyAll && brake(world, columns, all, loan, island)) {
        island.open = columns.ties.ask(island.ties, all.velocity);
        return;
    }
    for (IslandPoint& p : all.points) p.impulse *= share;
    for (TieRow& row : all.rows) row.impulse *= share;
    const std::span<const Vector6d> start = bodies_in(columns.start, island);
    for (std::size_t i = 0; i < start.size(); ++i)
        all.velocity[i] =
            share > 0 ? Vector6d(start[i] + share * (all.velocity[i] - start[i])) : start[i];
    island.open = columns.ties.ask(island.ties, all.velocity);
    island.solved = false;
}

void store_loan(const IslandColumns& columns, const ExactIsland& island, World& world) {
    double joints = 0;
    columns.ties.each(island.ties, [&](const Tie& tie) { joints += tie.kind == TieKind::joint; });
    columns.ties.each(island.ties, [&](const Tie& tie) {
        if (tie.kind == TieKind::joint) world.joints.joints[tie.index].owed = island.owed / joints;
    });
}

}  // namespace plumb
