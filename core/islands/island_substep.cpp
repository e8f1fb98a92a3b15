// SPDX-License-Identifier: MIT
#include "islands/island_substep.h"

#include "solve/free_turn.h"

#include <algorithm>

namespace plumb {
namespace {

/// How often an island is solved until its ties are closed; and at most, as long as each time
/// leaves no more than this share of what was open: near to where a linkage is stretched out it is
/// slow.
constexpr int kCloses = 8, kMostCloses = 40;
constexpr double kClosing = 0.8;

}  // namespace

void IslandSubstep::solve() {
    island_.account.begin_substep();
    if (island_.splits)
        open_apart();
    else if (island_.was_torn && island_.is_driven)
        hold_torn();
    else if (island_.effort == IslandEffort::swept)
        sweep();
    else
        solve_exactly();
    turn_back();
    const bool fails = island_.given_up || island_.effort == IslandEffort::swept;
    if (island_.is_meshed && island_.was_torn && fails) draw_together();
    if (!island_.ties.empty() && (!island_.solved || island_.given_up)) brake_torn();
}

/// Overlap goes by shifts, and the velocities are those of a heap that keeps it.
void IslandSubstep::open_apart() {
    island_.solved = true;
    if (island_.is_deep)
        solver_.sweep(all_);
    else
        island_.solved = solve_system(IslandEffort::light);
    give_up_if_in_vain();
    solver_.open_apart(all_, opening_, shift_);
    bound_speed();
}

void IslandSubstep::sweep() {
    solver_.sweep(all_);
    ask();
    island_.solved = true;
    if (is_flung()) return hold_torn();
    if (island_.is_meshed && gains()) close_gently();
    if (!island_.may_be_disputed) return;
    if (island_.flies && island_.gains_nothing) bound_swept_energy();
    bound_speed();
}

void IslandSubstep::solve_exactly() {
    const bool was_solved = close();
    if (!island_.solved && island_.may_be_disputed && island_.effort == IslandEffort::full) {
        island_.begin_dispute();
        island_.effort = IslandEffort::swept;
        island_.splits = !island_.flies;
    }
    give_up_if_in_vain();
    if (island_.parts) bound_energy(), ask();
    if (!island_.ties.empty()) judge_ties(was_solved);
}

/// Ties are not linear: what a solution leaves open of them is asked for again. Returns whether the
/// island was solved before the last closing, which changes little.
bool IslandSubstep::close() {
    const double tolerance = settings_.joint_tolerance;
    const int most = island_.is_meshed ? kMostCloses : kCloses;
    bool was_solved = false;
    for (int i = 0; i < most; ++i) {
        const double before = island_.open;
        was_solved |= island_.solved && i > 0;
        island_.solved = solve_system(island_.effort);
        turn_back();
        ask();
        const bool closes = !island_.is_meshed && island_.open <= 0.5 * before;
        if (!(island_.open > tolerance) || (!island_.solved && i > 0 && !closes)) break;
        if (i >= kCloses && !(island_.open <= kClosing * before)) break;
    }
    return was_solved;
}

/// Returns whether it is solved. What led to no numbers is swept, from the start.
bool IslandSubstep::solve_system(IslandEffort effort) {
    const IslandReport report =
        solver_.solve(all_, island_.system, island_.speed, effort,
                      island_.settling > 0 || island_.stirred, island_.account.left());
    island_.stirred |= report.stirred;
    island_.account.take(report.factorisations * island_.system.block_products());
    if (is_finite(all_.velocity)) return report.solved;
    IslandSolver::forget(all_);
    give_way();
    return false;
}

bool IslandSubstep::is_finite(std::span<const Vector6d> velocities) {
    return std::all_of(velocities.begin(), velocities.end(),
                       [](const Vector6d& x) { return x.allFinite(); });
}

/// Its levers turn by their loads (TiedJoints::stiffen).
void IslandSubstep::turn_back() {
    if (!island_.flies || island_.ties.empty()) return;
    const RigidMotion turn = plumb::turn_back(bodies_, kMissing, [&](auto visit) {
        for (std::size_t i = 0; i < start_.size(); ++i) {
            const Vector6d change = all_.velocity[i] - start_[i];
            visit(all_.bodies[i].body, {change.head<3>(), change.tail<3>()});
        }
    });
    if (turn.is_rest()) return;
    for (std::size_t i = 0; i < start_.size(); ++i) {
        const Velocity<double> more = turn.of(bodies_, all_.bodies[i].body);
        all_.velocity[i].head<3>() += more.v, all_.velocity[i].tail<3>() += more.w;
    }
}

/// What has taken too much in vain is swept from now on.
void IslandSubstep::give_up_if_in_vain() {
    if (island_.opens || !island_.account.end_substep(island_.solved)) return;
    island_.splits = false;
    island_.effort = IslandEffort::swept;
}

}  // namespace plumb
