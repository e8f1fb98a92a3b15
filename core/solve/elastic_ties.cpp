// SPDX-License-Identifier: MIT
#include "solve/elastic_ties.h"

#include "constraints/substep_time.h"
#include "ties/tie_work.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace plumb {
namespace {

/// How firm rows are. What takes motion away holds in any case: so many times as firm as all that
/// is tied is heavy, it is found in a round or two, also where light links bear a heavy load. What
/// drives an axis may let go, as contacts may: so many times its effective mass.
constexpr double kTieFirm = 100, kDriveFirm = 5;

/// A row that bears nothing, for its bounds are 0.
const TieRow kFree{};

}  // namespace

ElasticTies::ElasticTies(const World& world) {
    for (const Link& link : world.links)
        for (const WorldPoint* p : {&link.a, &link.b})
            if (p->particle != kNoIndex && world.particles.inverse_mass[p->particle] > 0)
                points_.push_back(p->particle);
    std::sort(points_.begin(), points_.end());
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
}

std::uint32_t ElasticTies::place_of(const World& world, const WorldPoint& point) const {
    if (!(world.particles.inverse_mass[point.particle] > 0)) return kImmovable;
    const auto found = std::lower_bound(points_.begin(), points_.end(), point.particle);
    return bodies_ + static_cast<std::uint32_t>(found - points_.begin());
}

void ElasticTies::clear(std::uint32_t bodies) {
    bodies_ = bodies;
    rows_.clear();
    rows_.begin_range(range_), rows_.end_range(range_);
    for (auto* column : {&impulse_, &applied_, &rate_, &way_, &slope_, &wanted_}) column->clear();
    laws_.clear(), pairs_.clear();
    tied_.assign(bodies_ + points_.size(), 0);
    mass_ = driven_energy_ = 0;
}

void ElasticTies::add(const World& world, const Tie& tie, TiedBodies at) {
    if (tie.kind == TieKind::link) {
        const Link& link = world.links[tie.index];
        if (link.a.particle != kNoIndex) at[0] = place_of(world, link.a);
        if (link.b.particle != kNoIndex) at[1] = place_of(world, link.b);
    }
    rows_.add(world, tie, at);
    rows_.end_range(range_);
    std::size_t side = 0;
    each_body(world, tie, [&](std::uint32_t body) {
        const std::uint32_t i = at[side++];
        if (i == kImmovable || std::exchange(tied_[i], 1)) return;
        mass_ += i < bodies_ ? world.bodies.mass[body] : world.particles.mass[particle(i)];
    });
    for (std::size_t i = 0; i < at.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (at[i] != kImmovable && at[k] != kImmovable && at[i] != at[k])
                pairs_.emplace_back(at[k], at[i]);
}

void ElasticTies::gather(const std::vector<Vector3d>& rows,
                         std::vector<Vector6d>& of_bodies) const {
    for (const std::uint32_t point : points_) {
        of_bodies.emplace_back(Vector6d::Zero());
        of_bodies.back().head<3>() = rows[point];
    }
}

void ElasticTies::add_to_rows(const std::vector<Vector6d>& of_bodies,
                              std::vector<Vector3d>& rows) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
        rows[points_[i]] += of_bodies[bodies_ + i].head<3>();
}

void ElasticTies::mark(SolvedTies& solved) const {
    rows_.each(range_, [&](const Tie& tie) { solved.mark(tie); });
}

void ElasticTies::begin(const World& world, double h) {
    holds_ = true;
    rows_.begin();
    rows_.begin(world, substep_time(world, h), range_);
    const std::span<TieRow> rows = rows_.rows();
    for (auto* column : {&impulse_, &applied_, &rate_, &way_, &slope_, &wanted_})
        column->assign(rows.size(), 0);
    for (TieRow& row : rows) {
        row.most = std::numeric_limits<double>::infinity();
        if (!world.settings.warm_start) row.impulse = 0;
    }
    rest_.assign(tied_.size(), Vector6d::Zero());
    rows_.ask(range_, rest_);
    find_driven_energy(world, h);
}

/// Motors and springs of drives do work; rows that are open close, and those that yield give back
/// what they hold.
void ElasticTies::find_driven_energy(const World& world, double h) {
    driven_energy_ = 0;
    for (const TieRow& row : rows_.rows())
        if (!row.drive)
            driven_energy_ += 0.5 * (row.mass * row.wanted * row.wanted +
                                     row.softness * row.impulse * row.impulse);
    rows_.each(range_, [&](const Tie& tie) {
        if (tie.kind != TieKind::joint) return;
        const double work = most_work(world, tie.index, h);
        const Joint& joint = world.joints.joints[tie.index];
        const bool yields = joint.compliance > 0 || joint.angular_compliance > 0;
        if (!yields || std::isfinite(work)) driven_energy_ += work;
    });
}

double ElasticTies::ask(std::span<const Vector6d> velocity) {
    const std::span<TieRow> rows = rows_.rows();
    for (std::size_t i = 0; i < rows.size(); ++i) wanted_[i] = rows[i].wanted;
    rows_.ask(range_, velocity);
    laws_.clear();
    double most = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const TieRow& row = rows[i];
        const double firm = std::max(row.mass, mass_ * row.length * row.length);
        RowLaw& law = laws_.emplace_back(row, row.drive ? kDriveFirm * row.mass : kTieFirm * firm);
        if (!holds_ && !is_of_particles(row)) law = RowLaw(kFree, 1);
        if (!row.drive) most = std::max(most, row.length * std::abs(row.wanted - wanted_[i]));
    }
    return most;
}

/// Those are never let go: they and what is elastic give no energy, and a load hangs on them.
bool ElasticTies::is_of_particles(const TieRow& row) const {
    const auto sides = row.sides();
    return std::any_of(sides.begin(), sides.end(),
                       [this](const RowSide& side) { return side.body >= bodies_; });
}

double ElasticTies::add_forces(std::span<const Vector6d> velocity, std::span<Vector6d> force) {
    const std::span<const TieRow> rows = rows_.rows();
    double energy = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const RowLaw& law = laws_[i];
        rate_[i] = rate_of(rows[i], velocity);
        const RowAnswer answer = answer_of(law, rate_[i]);
        impulse_[i] = answer.impulse, slope_[i] = answer.slope;
        add_impulse(rows[i], answer.impulse, force);
        // of a spring whose pull is bounded; of what drives an axis, about
        const double pull = law.impulse + law.slope * (law.wanted - law.yields - rate_[i]),
                     beyond = pull - answer.impulse;
        energy += 0.5 * (pull * pull - beyond * beyond) / law.slope;
    }
    return energy;
}

void ElasticTies::begin_line(std::span<const Vector6d> way) {
    const std::span<const TieRow> rows = rows_.rows();
    for (std::size_t i = 0; i < rows.size(); ++i) way_[i] = rate_of(rows[i], way);
}

double ElasticTies::push_along(double share) const {
    double sum = 0;
    for (std::size_t i = 0; i < laws_.size(); ++i)
        sum += answer_of(laws_[i], rate_[i] + share * way_[i]).impulse * way_[i];
    return sum;
}

void ElasticTies::list_stiffness(KeptFactors& made_of) const {
    made_of.rows.clear(), made_of.points = points_;
    for (std::size_t i = 0; i < laws_.size(); ++i) {
        if (slope_[i] == 0) continue;
        const TieRow& row = rows_.rows()[i];
        KeptFactors::Row& kept = made_of.rows.emplace_back();
        kept.count = row.count, kept.stiffness = slope_[i];
        kept.body.fill(kNoIndex), kept.on.fill(Vector6d::Zero());
        for (std::uint32_t k = 0; k < row.count; ++k)
            kept.body[k] = row.side[k].body, kept.on[k] = row.side[k].on;
    }
}

double ElasticTies::take_forces() {
    const std::span<TieRow> rows = rows_.rows();
    double most = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double changed = (impulse_[i] - rows[i].impulse) / laws_[i].stiffness;
        most = std::max(most, rows[i].length * std::abs(changed));
        rows[i].impulse = impulse_[i];
    }
    return most;
}

void ElasticTies::forget() {
    for (TieRow& row : rows_.rows()) row.impulse = 0;
}

void ElasticTies::store(std::span<const Vector6d> velocity, World& world) {
    for (std::size_t i = 0; i < applied_.size(); ++i) rows_.rows()[i].impulse = applied_[i];
    rows_.store_impulses(range_, velocity, world);
}

}  // namespace plumb
