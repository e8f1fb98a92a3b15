// SPDX-License-Identifier: MIT
/// What keeps an island from gaining energy that nothing gives it.
#include "contacts/contact_work.h"
#include "step/island_group.h"
#include "step/island_solver.h"

#include <algorithm>

namespace plumb {
namespace {

/// Bodies overlap at rest if they move, about their common centre, with less than this share of
/// the energy with which they are to part.
constexpr double kAtRest = 0.25;

/// Whether what a row asks for closes what is open; slack ropes ask for as much as they have.
bool closes(const IslandRow& row) {
    return !row.drive && !(row.highest == 0 && row.wanted > 0) &&
           !(row.lowest == 0 && row.wanted < 0);
}

/// Of all mass in its common centre.
double energy_of_centre(std::span<const IslandBody> bodies, std::span<const Vector6d> velocity) {
    double mass = 0;
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        mass += bodies[i].mass, sum += bodies[i].mass * velocity[i].head<3>();
    return 0.5 * sum.squaredNorm() / mass;
}

}  // namespace

/// Ties that were not closed must add no energy: from nothing, and at rates that are linear in the
/// velocities, they are closed by as large a share as there is energy for. It grows with the share
/// at least in proportion.
void IslandGroup::close_gently(IslandSolver& solver, ExactIsland& m) {
    const Island island = columns_.all_of(m);
    const std::span<const Vector6d> start = bodies_in(columns_.start, m);
    const double before = kinetic_energy(island.bodies, start);
    const auto begin = [&] { std::copy(start.begin(), start.end(), island.velocity.begin()); };
    const auto ask = [&](double share) {
        columns_.ties.ask(m.ties, island.velocity);
        for (IslandRow& row : island.rows)
            if (closes(row)) row.wanted *= share;
    };
    const auto close = [&](double share) {
        begin(), solver.forget(island), ask(share);
        if (!solve_system(solver, m, m.effort))
            begin(), solver.sweep_anew(island, [&] { ask(share); });
        return kinetic_energy(island.bodies, island.velocity);
    };
    const double whole = close(1);
    if (!(whole <= before)) {
        const double least = close(0);
        if (least < before) close((before - least) / (whole - least));
    }
    m.open = columns_.ties.ask(m.ties, island.velocity);
}

/// Where friction turns slip about, the speeds that restitution asks for can be more energy than
/// there was (Kane and Levinson 1985); and what flies about finds overlap wherever it turned into
/// another body, whose push-out is. Then only a share of what is asked for beyond rest is given:
/// energy grows with the share at least in proportion. What overlaps at rest is pushed out all the
/// same.
void IslandGroup::bound_energy(IslandSolver& solver, ExactIsland& m) {
    const Island island = columns_.all_of(m);
    const std::span<const Vector6d> start = bodies_in(columns_.start, m);
    const double before = kinetic_energy(island.bodies, start);
    const double whole = kinetic_energy(island.bodies, island.velocity);
    if (whole <= before) return;
    if (!m.bounces) {
        const double centre = energy_of_centre(island.bodies, start);
        if (before - centre < kAtRest * (whole - centre)) return;
    }
    const auto ask_for_more = [&](double share) {
        for (std::uint32_t k = m.first_point; k < m.last_point; ++k)
            columns_.points[k].wanted[0] += share * columns_.parting[k];
        m.solved &= solve_system(solver, m, m.effort);
        return kinetic_energy(island.bodies, island.velocity);
    };
    const double least = ask_for_more(-1);
    if (least < before) ask_for_more((before - least) / (whole - least));
}

/// What is wedged between surfaces that are all but parallel leaves many times as fast as these
/// part. Sweeps of a heap that was squeezed, and is left to itself, fling nothing out of it: only
/// such a share of their impulses is taken.
void IslandGroup::bound_speed(const World& world, const ExactIsland& m) {
    const Island island = columns_.all_of(m);
    const std::span<const Vector6d> start = bodies_in(columns_.start, m);
    const double share = share_without_flinging(world.settings, [&](auto visit) {
        for (std::size_t i = 0; i < island.bodies.size(); ++i)
            visit(start[i].head<3>(), (island.velocity[i] - start[i]).head<3>());
    });
    if (!(share < 1)) return;
    for (IslandPoint& p : island.points) p.impulse *= share;
    for (std::size_t i = 0; i < island.bodies.size(); ++i)
        island.velocity[i] = start[i] + share * (island.velocity[i] - start[i]);
}

}  // namespace plumb
