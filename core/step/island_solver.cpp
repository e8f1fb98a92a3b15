// SPDX-License-Identifier: MIT
#include "step/island_solver.h"

#include "math/matrices.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

// Shares of the speed at which the island's contacts would approach: what rests approaches by g h.

/// Where the law holds to this, nothing is done: what rests so stays as it is.
constexpr double kStop = 1e-8;

/// To this it is solved once it does not, and in the steps after that (kSettlingSteps); but for
/// what is missed by more than kMoves, which will not stay as it is anyway.
constexpr double kSettled = 1e-12, kMoves = 1e-6;

/// What an island may miss without counting as unsolved.
constexpr double kSolved = 1e-6;

/// γ is this share of what the residual is of the strongest push; slow modes of a structure are
/// missed by as little as their softness, so that γ comes down to theirs from round to round.
constexpr double kSoftnessShare = 0.3;
constexpr double kSoftest = 1, kHard = 1e-6, kHardest = 1e-11;

/// γ of what a joint takes away: it is never let go, so that no search is needed for it.
constexpr double kJoint = 1e-7;

/// γ of what drives a joint need not be more than this.
constexpr double kGentle = 1e-3;

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

/// The same of what rounds did not solve, again and again while they leave less than a share of it.
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
constexpr int kLineSteps = 20;

Matrix6d mass_matrix(const IslandBody& b) {
    Matrix6d m = Matrix6d::Zero();
    m.diagonal().head<3>().setConstant(b.mass);
    const Symmetric3<double>& i = b.inertia;
    m.bottomRightCorner<3, 3>() << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz;
    return m;
}

/// Visits all, from the first on or from the last.
template <class All, class Visit>
void each_in_order(All& all, bool forwards, Visit visit) {
    const std::size_t n = all.size();
    for (std::size_t k = 0; k < n; ++k) visit(all[forwards ? k : n - 1 - k]);
}

/// Between the bounds of what holds an axis [N s], [N m s]: an error must not take it from one to
/// the other.
double span_of(const AxisDrive& drive) {
    double span = std::numeric_limits<double>::infinity();
    for (int i = 0; i < drive.n; ++i) {
        const DriveRow& row = drive.rows[i];
        if (!(row.softness > 0) && row.highest > row.lowest)
            span = std::min(span, row.highest - row.lowest);
    }
    return span;
}

}  // namespace

void IslandSolver::sweep(const Island& island) {
    island_ = island;
    for (int i = 0; i < kSweeps; ++i) sweep_both_ways();
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
    island_ = {island.bodies, shift, apart_, {}};
    for (int i = 0; i < kOpeningSweeps; ++i)
        for (const bool forwards : {true, false})
            each_in_order(island_.points, forwards, [&](IslandPoint& p) { open(p); });
}

/// One contact of what is opened apart: pushes only, and yields.
[[gnu::flatten]] void IslandSolver::open(IslandPoint& p) {
    const double left = p.wanted[0] - velocity_of(p, island_.velocity)[0];
    const double step = (p.mass_normal * left - kYield * p.impulse[0]) / (1 + kYield);
    Vector6d more = Vector6d::Zero();
    more[0] = std::max(step, -p.impulse[0]);
    if (more[0] == 0) return;
    p.impulse[0] += more[0];
    push(p, more);
}

IslandReport IslandSolver::solve(const Island& island, BlockCholesky& system, double speed,
                                 IslandEffort effort, bool settles, std::uint64_t most_products) {
    island_ = island;
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
    enough_ = (report.residual > kMoves * speed ? kStop : kSettled) * speed;
    most_factorisations_ = most_products / std::max<std::uint64_t>(1, system.block_products());
    const bool may_stand = effort == IslandEffort::full && report.residual > kFar * speed &&
                           most_shift() < kFast * speed;
    if (!may_stand || !stands(report, speed)) improve(report, speed);
    if (effort == IslandEffort::full) sweep_on(report, speed);
    if (report.residual > speed) {
        take_back_impulses();
        sweep_anew(island, [] {});
    }
    report.solved = report.residual <= kSolved * speed;
    return report;
}

void IslandSolver::keep_row_impulses(const Island& island) {
    kept_row_impulse_.clear();
    for (const IslandRow& row : island.rows) kept_row_impulse_.push_back(row.impulse);
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
        begin_round(softness(share * before, hard), before);
        const int steps = before <= kMoves * speed ? kRefiningSteps
                          : shifts_                ? kNewtonSteps
                                                   : kStandsMore * kNewtonSteps;
        const bool found = minimise(kExact * before, steps, report.factorisations);
        if (found)
            take_impulses();
        else
            sweep_both_ways();
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

/// What rounds do not find: a ball that rolls off a wall slips along it as fast as it leaves, and
/// its shift swings to and fro for ever. Sweeps find that, or all is as it was.
void IslandSolver::sweep_on(IslandReport& report, double speed) {
    double before = kInfinity;
    while (report.residual > kSolved * speed && report.residual < kLeadsOn * before) {
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
    for (const IslandPoint& p : island_.points) push(p, -p.impulse);
    for (IslandRow& row : island_.rows) push(row, -row.impulse);
}

/// γ for an error of so much velocity [m/s], and no less than `hard` where masses are alike. What a
/// heavy body does to light ones is a mode as slow as their masses are apart.
double IslandSolver::softness(double error, double hard) const {
    double strongest = 0, lightest = island_.bodies[0].mass, heaviest = lightest;
    for (const IslandPoint& p : island_.points)
        strongest = std::max(strongest, p.impulse[0] / p.mass);
    for (const IslandRow& row : island_.rows)
        strongest = std::max(strongest, std::abs(row.impulse) / row.mass * row.length);
    for (const IslandBody& b : island_.bodies) {
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

[[gnu::flatten]] double IslandSolver::residual() const {
    const double slack = shifts_ ? creep_ : kInfinity;
    double worst = 0;
    for (const IslandPoint& p : island_.points) {
        Vector6d lack = p.wanted - velocity_of(p, island_.velocity);
        // what slides may lift by what the shift leaves it
        std::array<double, 3> slow = cone_lengths(lack);
        for (double& x : slow) x = std::min(x, slack);
        const double lift = slipping(p.impulse, slow, p.cone);
        if (lack[0] < 0) lack[0] = std::min(0.0, lack[0] + lift);
        const Vector6d off = lawful_step(p.impulse, lack, p.mass, p.cone) - p.impulse;
        worst = std::max(worst, off.cwiseAbs().maxCoeff() / p.mass);
    }
    for (const IslandRow& row : island_.rows) {
        const double rate = rate_of(row, island_.velocity);
        const double off = answer_of(row, rate, row.mass).impulse - row.impulse;
        worst = std::max(worst, std::abs(off) / row.mass * row.length);
    }
    return worst;
}

/// An impulse more at a point, to the velocities of its bodies.
[[gnu::flatten]] void IslandSolver::push(const IslandPoint& p, const Vector6d& impulse) {
    const Vector3d along = p.frame * impulse.head<3>();
    Vector3d about = Vector3d::Zero();
    if (p.cone.turns()) about = p.length * (p.frame * impulse.tail<3>());
    const auto push_body = [&](std::uint32_t i, const Vector3d& arm, double sign) {
        if (i == kImmovable) return;
        Vector6d sum;
        sum << sign * along, sign * (cross<double>(arm, along) + about);
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
void IslandSolver::push(IslandRow& row, double impulse) {
    row.impulse += impulse;
    for (const RowSide& side : row.sides())
        island_.velocity[side.body] += response(island_.bodies[side.body], impulse * side.on);
}

/// One projected Gauss–Seidel sweep.
void IslandSolver::sweep(bool forwards) {
    each_in_order(island_.rows, forwards, [&](IslandRow& row) {
        push(row, answer_of(row, rate_of(row, island_.velocity), row.mass).impulse - row.impulse);
    });
    each_in_order(island_.points, forwards, [&](IslandPoint& p) { sweep(p); });
}

/// The normal first, then the rest within its bounds.
[[gnu::flatten]] void IslandSolver::sweep(IslandPoint& p) {
    Vector6d lack = p.wanted - velocity_of(p, island_.velocity);
    Vector6d more = Vector6d::Zero();
    more[0] = std::clamp(p.mass_normal * lack[0], -p.impulse[0], p.cone.most - p.impulse[0]);
    p.impulse[0] += more[0];
    push(p, more);
    lack = p.wanted - velocity_of(p, island_.velocity);
    lack[0] = 0;
    more = lawful_step(p.impulse, lack, p.mass, p.cone) - p.impulse;
    p.impulse += more;
    push(p, more);
}

[[gnu::flatten]] void IslandSolver::begin_round(double softness, double error) {
    change_.assign(island_.bodies.size(), Vector6d::Zero());
    work_.resize(island_.points.size());
    for (std::size_t k = 0; k < work_.size(); ++k) {
        const IslandPoint& p = island_.points[k];
        PointWork& w = work_[k];
        w.stiffness = p.mass / softness;
        Vector6d lack = p.wanted - velocity_of(p, island_.velocity);
        if (shifts_) lack[0] -= slip_shift(p.impulse, lack, creep_, p.cone);
        w.z = p.impulse + w.stiffness * lack;
    }
    row_work_.clear();
    for (const IslandRow& row : island_.rows) {
        const double hardest = row.mass / (row.drive || row.is_one_sided() ? softness : kJoint);
        double gentle = hardest;
        if (row.drive)
            gentle = std::max(span_of(*row.drive) * row.length / error, row.mass / kGentle);
        row_work_.push_back({std::min(hardest, gentle), rate_of(row, island_.velocity), 0});
    }
}

/// Newton's method, until no body's momentum is off by more than `enough` of velocity [m/s].
bool IslandSolver::minimise(double enough, int steps, std::uint32_t& factorisations) {
    for (int i = 0; i < steps && factorisations < most_factorisations_; ++i) {
        const double off = find_downhill();
        if (off <= enough) return true;
        assemble();
        ++factorisations;
        if (!system_->factor()) return false;
        direction_ = downhill_;
        system_->solve(direction_);
        double decrease = 0;
        for (std::size_t b = 0; b < direction_.size(); ++b)
            decrease += direction_[b].dot(downhill_[b]);
        if (!(decrease > 0)) return true;
        for (std::size_t k = 0; k < work_.size(); ++k)
            work_[k].direction = velocity_of(island_.points[k], direction_);
        for (std::size_t k = 0; k < row_work_.size(); ++k)
            row_work_[k].direction = rate_of(island_.rows[k], direction_);
        const double step = step_length(decrease);
        for (std::size_t b = 0; b < direction_.size(); ++b) change_[b] += step * direction_[b];
        for (PointWork& w : work_) w.z -= (step * w.stiffness) * w.direction;
        for (RowWork& w : row_work_) w.rate += step * w.direction;
    }
    return false;
}

/// The force that leads downhill, into downhill_; returns the fastest velocity that it would make,
/// by the energy that it would give a body: turning counts by the radius of gyration.
[[gnu::flatten]] double IslandSolver::find_downhill() {
    downhill_.resize(island_.bodies.size());
    for (std::size_t b = 0; b < downhill_.size(); ++b)
        downhill_[b] = -momentum(island_.bodies[b], change_[b]);
    for (std::size_t k = 0; k < work_.size(); ++k) {
        const IslandPoint& p = island_.points[k];
        add_impulse(p, nearest_on_cone(work_[k].z, p.cone).impulse - p.impulse, downhill_);
    }
    for (std::size_t k = 0; k < row_work_.size(); ++k) {
        const IslandRow& row = island_.rows[k];
        const RowWork& w = row_work_[k];
        add_impulse(row, answer_of(row, w.rate, w.stiffness).impulse - row.impulse, downhill_);
    }
    double off = 0;
    for (std::size_t b = 0; b < downhill_.size(); ++b) {
        const IslandBody& body = island_.bodies[b];
        off = std::max(off, downhill_[b].dot(response(body, downhill_[b])) / body.mass);
    }
    return std::sqrt(off);
}

/// Second derivatives, block by block: M, of each point [E, −[r]ₓ]ᵀ K [E, −[r]ₓ], and of each row
/// on k onᵀ.
[[gnu::flatten]] void IslandSolver::assemble() {
    system_->clear();
    for (std::size_t b = 0; b < island_.bodies.size(); ++b)
        system_->add(static_cast<std::uint32_t>(b), mass_matrix(island_.bodies[b]));
    for (std::size_t k = 0; k < work_.size(); ++k) {
        const IslandPoint& p = island_.points[k];
        const PointWork& w = work_[k];
        const ConePoint at = nearest_on_cone(w.z, p.cone);
        if (!at.pushes) continue;
        // K in the world's frame: of forces to velocities, and between those and torques
        Matrix3d along = w.stiffness * Matrix3d::Identity(), mixed = Matrix3d::Zero(),
                 about = mixed;
        if (!at.inside()) {
            const Matrix6d d = w.stiffness * cone_derivative(w.z, at, p.cone);
            along = p.frame * d.topLeftCorner<3, 3>() * p.frame.transpose();
            if (p.cone.turns()) {
                mixed = p.length * p.frame * d.topRightCorner<3, 3>() * p.frame.transpose();
                about = p.length * p.length * p.frame * d.bottomRightCorner<3, 3>() *
                        p.frame.transpose();
            }
        } else if (p.cone.turns()) {
            about = w.stiffness * p.length * p.length * Matrix3d::Identity();
        }
        const Matrix3d ra = skew(p.arm_a), rb = skew(p.arm_b);
        const auto block = [&](const Matrix3d& left, const Matrix3d& right, double sign) {
            const Matrix3d upper = mixed - along * right, lower = mixed.transpose() + left * along;
            Matrix6d m;
            m << sign * along, sign * upper, sign * lower,
                sign * (about + left * upper - mixed.transpose() * right);
            return m;
        };
        if (p.a != kImmovable) system_->add(p.a, block(ra, ra, 1));
        if (p.b != kImmovable) system_->add(p.b, block(rb, rb, 1));
        if (p.a != kImmovable && p.b != kImmovable) system_->add(p.a, p.b, block(ra, rb, -1));
    }
    for (std::size_t k = 0; k < row_work_.size(); ++k) {
        const IslandRow& row = island_.rows[k];
        const double slope = answer_of(row, row_work_[k].rate, row_work_[k].stiffness).slope;
        if (slope == 0) continue;
        for (std::uint32_t i = 0; i < row.count; ++i) {
            const RowSide& a = row.side[i];
            system_->add(a.body, slope * a.on * a.on.transpose());
            for (std::uint32_t j = i + 1; j < row.count; ++j)
                system_->add(a.body, row.side[j].body, slope * a.on * row.side[j].on.transpose());
        }
    }
}

/// Derivative of what is minimised along the direction; rises with the step.
[[gnu::flatten]] double IslandSolver::slope(double step) const {
    double sum = 0;
    for (std::size_t b = 0; b < direction_.size(); ++b)
        sum += direction_[b].dot(momentum(island_.bodies[b], change_[b] + step * direction_[b]));
    for (std::size_t k = 0; k < work_.size(); ++k) {
        const PointWork& w = work_[k];
        const IslandPoint& p = island_.points[k];
        const Vector6d z = w.z - (step * w.stiffness) * w.direction;
        sum -= (nearest_on_cone(z, p.cone).impulse - p.impulse).dot(w.direction);
    }
    for (std::size_t k = 0; k < row_work_.size(); ++k) {
        const RowWork& w = row_work_[k];
        const IslandRow& row = island_.rows[k];
        const RowAnswer answer = answer_of(row, w.rate + step * w.direction, w.stiffness);
        sum -= (answer.impulse - row.impulse) * w.direction;
    }
    return sum;
}

/// The step at which the slope is about 0: 1, or less.
double IslandSolver::step_length(double decrease) const {
    const double enough = 0.1 * decrease;
    double low = 0, high = 1, at_low = -decrease, at_high = slope(1);
    if (at_high <= enough) return 1;
    double step = 1;
    for (int i = 0; i < kLineSteps; ++i) {
        const double guess = low - at_low * (high - low) / (at_high - at_low);
        const double inset = 0.05 * (high - low);
        step = std::clamp(guess, low + inset, high - inset);
        const double s = slope(step);
        if (std::abs(s) <= enough) break;
        if (s > 0)
            high = step, at_high = s;
        else
            low = step, at_low = s;
    }
    return step;
}

/// The impulses of the minimum, and the velocities that they make: momentum is kept to rounding.
void IslandSolver::take_impulses() {
    for (std::size_t k = 0; k < work_.size(); ++k) {
        IslandPoint& p = island_.points[k];
        const Vector6d more = nearest_on_cone(work_[k].z, p.cone).impulse - p.impulse;
        p.impulse += more;
        push(p, more);
    }
    for (std::size_t k = 0; k < row_work_.size(); ++k) {
        IslandRow& row = island_.rows[k];
        const RowWork& w = row_work_[k];
        push(row, answer_of(row, w.rate, w.stiffness).impulse - row.impulse);
    }
}

}  // namespace plumb
