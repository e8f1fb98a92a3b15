// SPDX-License-Identifier: MIT
#include "islands/island_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

// Shares of the speed at which the island's contacts would approach: what rests approaches by g h.

/// Where the law holds to this, nothing is done: what rests so stays as it is.
constexpr double kStop = 1e-8;

/// To this it is solved once it does not, and in the steps after that (kSettlingSteps). What is
/// missed by more than kMoves will not stay as it is anyway, and is solved to kStop. A heap of more
/// than so many bodies that is missed by more than kStirs is solved to kSolved: in the next step
/// its forces are others.
constexpr double kSettled = 1e-12, kMoves = 1e-6, kStirs = 1e-3;

/// What an island may miss without counting as unsolved.
constexpr double kSolved = 1e-6;

/// γ is this share of what the residual is of the strongest push; slow modes of a structure are
/// missed by as little as their softness, so that γ comes down to theirs from round to round.
constexpr double kSoftnessShare = 0.3;
constexpr double kSoftest = 1, kHard = 1e-6, kHardest = 1e-11;

/// By which γ grows where Newton's method did not end, and shrinks where a round leaves more than
/// this share of the residual: heavy bodies on light ones, and the slowest modes of a large heap,
/// feel a soft contact for many rounds. Near the end it is γ's lower bound that shrinks.
constexpr double kSofter = 30, kSlow = 0.2, kFar = 1e-2;

/// A round's minimum is found to this share of the residual before it.
constexpr double kExact = 0.03;

/// Rounds that every island may take, and that one may take which is not yet solved.
constexpr int kRounds = 4, kMostRounds = 16;

/// Newton's steps in a round, and factorisations after which none begins. What may stand gets twice
/// as much: arches that friction hardly holds find their forces only once.
/// What is refined converges at once, or is at what rounding leaves.
constexpr int kNewtonSteps = 20, kRefiningSteps = 8, kStandsMore = 2;
constexpr std::uint32_t kEnoughFactorisations = 60;

/// With little work: so many rounds at least, no other after so many factorisations, and γ is more
/// at first, so that its minimum is found.
constexpr int kLightRounds = 1;
constexpr std::uint32_t kLightFactorisations = 10;
constexpr double kLightShare = 30;

/// Sweeps of an island that is swept, there and back.
constexpr int kSweeps = 20;

/// The same before or after rounds, again and again while they leave less than a share of it.
constexpr int kSweepsOn = 5;
constexpr double kLeadsOn = 0.5;

/// The same of what is opened apart. Each contact yields by this share of what it pushes: such as
/// contradict each other then come to a balance, in which nothing shifts any more.
constexpr int kOpeningSweeps = 10;
constexpr double kYield = 0.3;

/// An island may stand that slips no faster than this; one slides where the shift is so many times
/// the residual.
constexpr double kFast = 2, kClear = 100;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Visits all, from the first on or from the last.
template <class All, class Visit>
void each_in_order(All& all, bool forwards, Visit visit) {
    const std::size_t n = all.size();
    for (std::size_t k = 0; k < n; ++k) visit(all[forwards ? k : n - 1 - k]);
}

}  // namespace

void IslandSolver::take(const Island& island) {
    island_ = island;
    turns_ = std::any_of(island.points.begin(), island.points.end(),
                         [](const IslandPoint& p) { return p.cone.turns(); });
}

void IslandSolver::sweep(const Island& island) {
    take(island);
    for (int i = 0; i < kSweeps; ++i) sweep_both_ways();
}

bool IslandSolver::sweep_until(const Island& island, double speed, int most) {
    take(island);
    creep_ = kCreep * speed, shifts_ = true;
    for (int i = 1; i <= most; ++i) {
        sweep_both_ways();
        if (i % kSweepsOn == 0 && residual() <= kSolved * speed) return true;
    }
    return false;
}

void IslandSolver::open_apart(const Island& island, std::span<const double> opening,
                              std::span<Vector6d> shift) {
    apart_.assign(island.points.begin(), island.points.end());
    for (std::size_t k = 0; k < apart_.size(); ++k) {
        IslandPoint& p = apart_[k];
        p.wanted[0] = p.wanted[0] + opening[k] - velocity_of(p, island.velocity)[0];
        p.impulse[0] = 0;
        p.cone = {};
    }
    take({island.bodies, shift, apart_, {}});
    for (int i = 0; i < kOpeningSweeps; ++i)
        for (const bool forwards : {true, false})
            each_in_order(island_.points, forwards, [&](IslandPoint& p) { open(p); });
}

/// One contact of what is opened apart: pushes only, and yields.
[[gnu::flatten]] void IslandSolver::open(IslandPoint& p) {
    const double left = p.wanted[0] - velocity_of<3>(p, island_.velocity)[0];
    const double step = (p.mass_normal * left - kYield * p.impulse[0]) / (1 + kYield);
    Vector3d more = Vector3d::Zero();
    more[0] = std::max(step, -p.impulse[0]);
    if (more[0] == 0) return;
    p.impulse[0] += more[0];
    push(p, more);
}

IslandReport IslandSolver::solve(const Island& island, IslandSystem& system, double speed,
                                 IslandEffort effort, bool settles, std::uint64_t most_products) {
    take(island);
    system_ = &system;
    effort_ = effort;
    creep_ = kCreep * speed;
    shifts_ = true;
    IslandReport report;
    report.residual = residual();
    const double stop = (settles ? kSettled : kStop) * speed;
    if (report.residual <= stop) return report;

    sweep_both_ways();
    report.residual = residual();
    if (report.residual <= stop) return report;
    report.stirred = report.residual > kStop * speed;
    const bool stirs = report.residual > kStirs * speed && island.bodies.size() > kHeap;
    enough_ = (stirs ? kSolved : report.residual > kMoves * speed ? kStop : kSettled) * speed;
    most_factorisations_ = most_products / std::max<std::uint64_t>(1, system.block_products());
    if (!stands_or_slides(report, speed)) improve(report, speed);
    if (effort == IslandEffort::full) sweep_on(report, kSolved * speed);
    if (report.residual > speed) {
        take_back_impulses();
        sweep_anew(island, [] {});
    }
    report.solved = report.residual <= kSolved * speed;
    return report;
}

void IslandSolver::keep_row_impulses(const Island& island) {
    kept_row_impulse_.clear();
    for (const TieRow& row : island.rows) kept_row_impulse_.push_back(row.impulse);
}

/// Velocities and impulses as they are now.
void IslandSolver::keep_state() {
    kept_velocity_.assign(island_.velocity.begin(), island_.velocity.end());
    kept_impulse_.clear();
    for (const IslandPoint& p : island_.points) kept_impulse_.push_back(p.impulse);
    keep_row_impulses(island_);
}

void IslandSolver::restore_state() {
    std::copy(kept_velocity_.begin(), kept_velocity_.end(), island_.velocity.begin());
    for (std::size_t k = 0; k < kept_impulse_.size(); ++k)
        island_.points[k].impulse = kept_impulse_[k];
    for (std::size_t k = 0; k < kept_row_impulse_.size(); ++k)
        island_.rows[k].impulse = kept_row_impulse_[k];
}

/// Whether the island stands, or sweeps find how it slides, if nothing ties it: friction that slips
/// is all but known, and rounds may swing to and fro with it until they have taken all that they
/// may.
bool IslandSolver::stands_or_slides(IslandReport& report, double speed) {
    if (effort_ != IslandEffort::full) return false;
    const bool slides = most_shift() >= kFast * speed;
    if (!slides && !(report.residual > kFar * speed)) return false;
    if (!slides && stands(report, speed)) return true;
    if (island_.rows.empty()) sweep_on(report, enough_);
    return report.residual <= enough_;
}

/// Whether the island stands. Then it solves a convex problem, without de Saxcé's shift: rounds
/// that are not done yet slip, and would be shifted away from it. Otherwise all is as it was.
bool IslandSolver::stands(IslandReport& report, double speed) {
    keep_state();
    const double residual_before = report.residual;

    shifts_ = false;
    report.residual = residual();
    improve(report, speed);
    shifts_ = true;
    report.residual = residual();
    if (report.residual <= kSolved * speed) return true;

    restore_state();
    report.residual = residual_before;
    return false;
}

/// Rounds, until the law of contact holds.
void IslandSolver::improve(IslandReport& report, double speed) {
    const bool light = effort_ == IslandEffort::light;
    double share = light ? kLightShare : kSoftnessShare, hard = kHard;
    const std::uint32_t most =
        shifts_ ? kEnoughFactorisations : kStandsMore * kEnoughFactorisations;
    const std::uint32_t enough = report.factorisations + (light ? kLightFactorisations : most);
    const auto goes_on = [&](int round) {
        if (report.residual <= enough_) return false;
        if (!shifts_ && most_shift() > kClear * report.residual) return false;
        if (round < (light ? kLightRounds : kRounds)) return true;
        return round < kMostRounds && report.residual > kSolved * speed &&
               report.factorisations < std::min<std::uint64_t>(enough, most_factorisations_);
    };
    for (int round = 0; goes_on(round); ++round) {
        const double before = report.residual;
        const int steps = before <= kMoves * speed ? kRefiningSteps
                          : shifts_                ? kNewtonSteps
                                                   : kStandsMore * kNewtonSteps;
        const double soft = softness(share * before, hard);
        const bool found = turns_ ? minimise(turning_, soft, before, steps, report.factorisations)
                                  : minimise(plain_, soft, before, steps, report.factorisations);
        if (!found) sweep_both_ways();
        report.residual = residual();
        if (!found && before <= kMoves * speed) return;
        if (!found)
            share *= kSofter;
        else if (report.residual > kSlow * before && report.residual > kFar * speed)
            share /= kSofter;
        else if (report.residual > kSlow * before)
            hard /= kSofter;
    }
}

/// A round: whether its minimum is found, and taken.
template <int N>
bool IslandSolver::minimise(IslandNewton<N>& newton, double softness, double before, int steps,
                            std::uint32_t& factorisations) {
    newton.begin(island_, softness, before, shifts_, creep_);
    if (!newton.minimise(*system_, kExact * before, steps, factorisations, most_factorisations_))
        return false;
    // momentum is kept to rounding
    newton.take_impulses([&](auto& what, const auto& more) { push(what, more); });
    return true;
}

/// What rounds do not find, or should not look for: a ball that rolls off a wall slips along it as
/// fast as it leaves, and its shift swings to and fro for ever. Sweeps find that, or all is as it
/// was.
void IslandSolver::sweep_on(IslandReport& report, double enough) {
    double before = kInfinity;
    while (report.residual > enough && report.residual < kLeadsOn * before) {
        before = report.residual;
        keep_state();
        for (int i = 0; i < kSweepsOn; ++i) sweep_both_ways();
        report.residual = residual();
        if (report.residual < before) continue;
        restore_state();
        report.residual = before;
    }
}

void IslandSolver::take_back_impulses() {
    for (const IslandPoint& p : island_.points) push(p, Vector6d(-p.impulse));
    for (TieRow& row : island_.rows) push(row, -row.impulse);
}

/// γ for an error of so much velocity [m/s], and no less than `hard` where masses are alike. What a
/// heavy body does to light ones is a mode as slow as their masses are apart.
double IslandSolver::softness(double error, double hard) const {
    double strongest = 0, lightest = island_.bodies[0].mass, heaviest = lightest;
    for (const IslandPoint& p : island_.points)
        strongest = std::max(strongest, p.impulse[0] / p.mass);
    for (const TieRow& row : island_.rows)
        strongest = std::max(strongest, std::abs(row.impulse) / row.mass * row.length);
    for (const SolvedBody& b : island_.bodies) {
        lightest = std::min(lightest, b.mass);
        heaviest = std::max(heaviest, b.mass);
    }
    const double hardest = std::max(kHardest, hard * lightest / heaviest);
    return error < strongest * kSoftest ? std::max(hardest, error / strongest) : kSoftest;
}

/// The greatest of the shifts that slip asks for.
[[gnu::flatten]] double IslandSolver::most_shift() const {
    double most = 0;
    for (const IslandPoint& p : island_.points) {
        const Vector6d slip = p.wanted - velocity_of(p, island_.velocity);
        if (p.impulse[0] > 0) most = std::max(most, slip_shift(p.impulse, slip, creep_, p.cone));
    }
    return most;
}

/// By how much the law is missed at the points [m/s].
template <int N>
double IslandSolver::residual_of_points() const {
    const double slack = shifts_ ? creep_ : kInfinity;
    double worst = 0;
    for (const IslandPoint& p : island_.points) {
        const ContactVector<N> impulse = p.impulse.template head<N>();
        ContactVector<N> lack = p.wanted.template head<N>() - velocity_of<N>(p, island_.velocity);
        // what slides may lift by what the shift leaves it
        auto slow = cone_lengths(lack);
        for (double& x : slow) x = std::min(x, slack);
        const double lift = slipping(impulse, slow, p.cone);
        if (lack[0] < 0) lack[0] = std::min(0.0, lack[0] + lift);
        const ContactVector<N> off = lawful_step(impulse, lack, p.mass, p.cone) - impulse;
        worst = std::max(worst, off.cwiseAbs().maxCoeff() / p.mass);
    }
    return worst;
}

double IslandSolver::residual() const {
    double worst = turns_ ? residual_of_points<6>() : residual_of_points<3>();
    for (const TieRow& row : island_.rows) {
        const double rate = rate_of(row, island_.velocity);
        const double off = answer_of(row, rate, row.mass).impulse - row.impulse;
        worst = std::max(worst, std::abs(off) / row.mass * row.length);
    }
    return worst;
}

/// An impulse more at a point, to the velocities of its bodies.
template <int N>
void IslandSolver::push(const IslandPoint& p, const ContactVector<N>& impulse) {
    const PointForce force(p, impulse);
    const auto push_body = [&](std::uint32_t i, const Vector3d& arm, double sign) {
        if (i == kImmovable) return;
        Vector6d sum;
        sum << sign * force.along, sign * (cross<double>(arm, force.along) + force.about);
        island_.velocity[i] += response(island_.bodies[i], sum);
    };
    push_body(p.a, p.arm_a, 1);
    push_body(p.b, p.arm_b, -1);
}

void IslandSolver::sweep_both_ways() {
    sweep(true);
    sweep(false);
}

/// The same of a row, which remembers it.
void IslandSolver::push(TieRow& row, double impulse) {
    row.impulse += impulse;
    for (const RowSide& side : row.sides())
        island_.velocity[side.body] += response(island_.bodies[side.body], impulse * side.on);
}

/// One projected Gauss–Seidel sweep.
void IslandSolver::sweep(bool forwards) {
    each_in_order(island_.rows, forwards, [&](TieRow& row) {
        push(row, answer_of(row, rate_of(row, island_.velocity), row.mass).impulse - row.impulse);
    });
    each_in_order(island_.points, forwards,
                  [&](IslandPoint& p) { turns_ ? sweep<6>(p) : sweep<3>(p); });
}

/// The normal first, then the rest within its bounds. What is open and stays so bears nothing, and
/// there is much of that.
template <int N>
void IslandSolver::sweep(IslandPoint& p) {
    const auto lack_now = [&]() -> ContactVector<N> {
        return p.wanted.template head<N>() - velocity_of<N>(p, island_.velocity);
    };
    auto impulse = p.impulse.template head<N>();
    const auto add = [&](const ContactVector<N>& more) {
        if (more.isZero(0)) return;
        impulse += more;
        push(p, more);
    };
    ContactVector<N> more = ContactVector<N>::Zero();
    more[0] = std::clamp(p.mass_normal * lack_now()[0], -impulse[0], p.cone.most - impulse[0]);
    add(more);
    if (impulse.isZero(0)) return;
    ContactVector<N> lack = lack_now();
    lack[0] = 0;
    add(lawful_step(ContactVector<N>(impulse), lack, p.mass, p.cone) - impulse);
}

}  // namespace plumb
