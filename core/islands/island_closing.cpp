// SPDX-License-Identifier: MIT
/// What is done about the ties of an island that stay open, or that only more energy than there is
/// would close.
#include "islands/island_substep.h"

#include "solve/rest_motion.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Ties may be closed at other velocities, too, than those that a substep leads to: such that turn
/// bodies about. They are known by the energy that they add, as a share of what there is.
constexpr double kOtherRoot = 0.25;

/// More energy than so many times what there is did not come from what drives an island.
constexpr double kFlung = 4;

/// The least share of its velocities that what is torn keeps, else none.
constexpr double kLeastKept = 1.0 / 16;

/// Whether what a row asks for closes what is open; slack ropes ask for as much as they have.
bool closes(const TieRow& row) {
    return !row.drive && !(row.highest == 0 && row.wanted > 0) &&
           !(row.lowest == 0 && row.wanted < 0);
}

}  // namespace

/// Once it is solved as far as that goes. `was_solved`: before the last closing.
void IslandSubstep::judge_ties(bool was_solved) {
    if (is_pulled_apart()) return hold_torn();
    if (island_.is_meshed && gains(island_.was_open ? 0 : kOtherRoot)) return close_gently();
    const double tolerance = settings_.joint_tolerance;
    if ((island_.solved || (was_solved && !island_.is_meshed)) && !(island_.open > tolerance))
        return;
    const bool ajar = island_.open <= kAjar * tolerance;
    island_.given_up |= !ajar && island_.may_give_up;
    // motors of a tree may give some
    const double given = island_.is_meshed || !ajar ? 0 : kOtherRoot;
    if ((island_.is_meshed && island_.solved && ajar) || !gains(given)) return;
    island_.given_up = true;
    island_.is_meshed ? close_gently() : give_way();
}

/// Whether kinematic bodies pull its ties apart: what these give is what their softness makes of an
/// impulse without bounds. As the start of the next substep it would throw the bodies about.
bool IslandSubstep::is_pulled_apart() const {
    if (!island_.is_driven) return false;
    if (!std::isfinite(island_.open)) return true;
    const double ajar = kAjar * settings_.joint_tolerance;
    return std::any_of(all_.rows.begin(), all_.rows.end(), [&](const TieRow& row) {
        return row.is_rigid && h_ * row.softness * std::abs(row.impulse) > ajar;
    });
}

/// Whether sweeps gave what kinematic bodies drive much more energy than it had, or has at their
/// speed.
bool IslandSubstep::is_flung() const {
    if (!island_.is_driven || island_.ties.empty()) return false;
    double mass = 0;
    for (const SolvedBody& b : all_.bodies) mass += b.mass;
    const double speed = ties_.scripted_speed(island_.ties);
    return !(energy() <= kFlung * (energy_at_start() + 0.5 * mass * speed * speed));
}

/// Sweeps that begin with nothing pull no harder than what moves asks for.
void IslandSubstep::give_way() {
    begin_anew();
    solver_.sweep_anew(all_, [&] { ask(); });
    ask();
}

/// What is pulled apart moves as if its ties had been made as they are, between bodies that stand
/// still: neither old errors nor what pulls get impulses or velocities.
void IslandSubstep::hold_torn() {
    const auto ask_to_hold = [&] { ties_.ask(island_.ties, all_.velocity, OldErrors::kept); };
    begin_anew();
    IslandSolver::forget(all_);  // of contacts, too, which held against what pulled
    ask_to_hold();
    island_.solved = solve_system(island_.effort);
    if (!island_.solved) {
        begin_anew();
        solver_.sweep_anew(all_, ask_to_hold);
    }
    draw_together();
}

/// Shifts the bodies so that what is open shares itself out and closes, unless that makes it worse:
/// rows that contradict each other in turning can lead anywhere.
void IslandSubstep::draw_together() {
    const double most = ties_.open_at_start(island_.ties) + h_ * ties_.scripted_speed(island_.ties);
    solver_.close_apart(all_, shift_, [&] { ties_.ask(island_.ties, shift_); });
    island_.open = ties_.open_at_end(island_.ties, shift_);
    const bool is_worse = !(island_.open <= most) || !is_finite(shift_);
    for (std::size_t i = 0; i < shift_.size(); ++i)
        shift_[i] = is_worse ? Vector6d(Vector6d::Zero()) : Vector6d(shift_[i] - all_.velocity[i]);
}

/// What is not solved opens its ties by no more than another substep may close again: its
/// velocities are halved against rest until then, where all stays as open as it is.
void IslandSubstep::brake_torn() {
    const double most = ties_.open_at_start(island_.ties) +
                        h_ * (settings_.recovery_speed + ties_.scripted_speed(island_.ties));
    if (island_.open <= most) return;
    const RigidMotion rest = rest_of(bodies_, island_.flies, all_.bodies, start_);
    double share = 1;
    while (!(island_.open <= most) && share > 0) {
        const double kept = share > kLeastKept ? 0.5 : 0;
        share *= kept;
        brake(bodies_, rest, 1 - kept, all_.bodies, all_.velocity);
        for (IslandPoint& p : all_.points) p.impulse *= kept;
        for (TieRow& row : all_.rows) row.impulse *= kept;
        if (kept == 0) IslandSolver::forget(all_);  // what is no number, too
        ask();
    }
    island_.solved = false;
}

/// Ties that were not closed must add no energy: from nothing, and at rates that are linear in the
/// velocities, they are closed by as large a share as there is energy for. It grows with the share
/// at least in proportion.
void IslandSubstep::close_gently() {
    const double before = energy_at_start();
    const auto ask_for = [&](double share) {
        ties_.ask(island_.ties, all_.velocity);
        for (TieRow& row : all_.rows)
            if (closes(row)) row.wanted *= share;
    };
    const auto close_by = [&](double share) {
        begin_anew(), IslandSolver::forget(all_), ask_for(share);
        if (!solve_system(island_.effort))
            begin_anew(), solver_.sweep_anew(all_, [&] { ask_for(share); });
        return energy();
    };
    const double whole = close_by(1);
    if (!(whole <= before)) {
        const double least = close_by(0);
        if (least < before) close_by((before - least) / (whole - least));
    }
    ask();
}

}  // namespace plumb
