// SPDX-License-Identifier: MIT
#include "step/island_loan.h"

#include "step/energy_loan.h"
#include "ties/tie_work.h"

#include <limits>

namespace plumb {
namespace {

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

}  // namespace

void bound_gain(const World& world, IslandColumns& columns, ExactIsland& island) {
    island.owed = 0;
    if (island.ties.empty() || island.is_driven) return;
    const EnergyLoan loan = loan_of(world, columns, island);
    const double share = loan.share();
    island.owed = loan.owed_after(share);
    if (share == 1) return;
    const Island all = columns.all_of(island);
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
