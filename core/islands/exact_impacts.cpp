// SPDX-License-Identifier: MIT
#include "islands/exact_impacts.h"

#include "contacts/contact_measures.h"
#include "contacts/contact_work.h"
#include "islands/work_of_change.h"

#include <algorithm>
#include <limits>

namespace plumb {
namespace {

/// No contact of a collision that can be solved bears more than so many times all momentum.
constexpr double kHardestBlow = 10, kAllButAll = 0.9;

/// Sweeps there and back, which are enough for most; and what the solution of the others may miss
/// of that speed. Where friction leads it about in circles it misses more, and many sweeps do
/// better.
constexpr int kFewSweeps = 20, kMostSweeps = 500;
constexpr double kMayMiss = 1e-3;

}  // namespace

void ExactImpacts::solve(World& world, Impacts& impacts, std::size_t island, double h) {
    fill(world, impacts, island);
    ask(world, impacts, h);
    settle();
    keep(compressed_);
    const double of_compression = work_of_drivers();
    if (is_jammed_) {
        hold_back(world.settings);
    } else if (give_back(world)) {
        settle();
        bound_energy(of_compression);
    }
    impacts.add_work(island, work_of_drivers());

    const ContactIslands& islands = impacts.islands();
    const auto first = islands.bodies().begin() + impacts.colliding()[island].first_body;
    for (std::size_t i = 0; i < columns_.bodies.size(); ++i) {
        const Vector6d change = columns_.velocity[i] - columns_.start[i];
        impacts.changes()[first[static_cast<std::ptrdiff_t>(i)]] = {change.head<3>(),
                                                                    change.tail<3>()};
    }
    for (std::size_t k = 0; k < columns_.points.size(); ++k) {
        const IslandPoint& p = columns_.points[k];
        borne_.push_back({island, columns_.contacts[k], p.impulse[0], friction_of(p)});
    }
}

void ExactImpacts::fill(const World& world, const Impacts& impacts, std::size_t island) {
    const ContactIslands& islands = impacts.islands();
    const ContactIsland& from = impacts.colliding()[island];
    columns_.clear(), pattern_.clear();
    const auto place = [&](std::int32_t row) {
        return row < world.dynamic_count ? islands.index_in_island(row) : kImmovable;
    };
    columns_.bodies.resize(from.last_body - from.first_body);
    for (std::uint32_t i = from.first_body; i < from.last_body; ++i)
        columns_.bodies[i - from.first_body].body = world.body_of_row[islands.bodies()[i]];
    for (std::uint32_t i = from.first_pair; i < from.last_pair; ++i) {
        const BodyPair& pair = impacts.near()[islands.pairs()[i]];
        const std::uint32_t a = place(pair.row_a), b = place(pair.row_b);
        if (a != kImmovable && b != kImmovable) pattern_.emplace_back(a, b);
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            if (!world.contacts.is_passing(k)) columns_.add_point(world, k, a, b);
    }
    const auto n = static_cast<std::uint32_t>(columns_.bodies.size());
    system_.analyse(n, pattern_, false, kAnyProducts, spare_);
    columns_.size_velocities();
    columns_.take_geometry(world);
    for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t body = columns_.bodies[i].body;
        columns_.start[i] << impacts.start()[body], world.bodies.angular_velocity_now[body];
        columns_.velocity[i] = columns_.start[i];
    }
}

/// What may approach does so until its gap is closed.
void ExactImpacts::ask(const World& world, const Impacts& impacts, double h) {
    const Bodies& b = world.bodies;
    speed_ = 0, is_jammed_ = false, drivers_.clear();
    double mass = 0;
    for (const SolvedBody& body : columns_.bodies) mass += body.mass;
    for (std::size_t k = 0; k < columns_.points.size(); ++k) {
        const std::uint32_t contact = columns_.contacts[k];
        IslandPoint& p = columns_.points[k];
        const OwnMotion own(world, p, contact, impacts.start(), b.angular_velocity_now);
        if (!own.is_none()) drivers_.push_back({k, own});
        p.wanted.setZero();
        p.wanted[0] = -std::max(0.0, world.contacts.gap[contact]) / h;
        own.take_from(p);
        speed_ = std::max(speed_, std::abs(velocity_of(p, columns_.velocity)[0] +
                                           p.frame.col(0).dot(own.moving)));
    }
    for (IslandPoint& p : columns_.points) p.cone.most = kHardestBlow * mass * speed_;
}

void ExactImpacts::keep(State& state) const {
    state.velocity = columns_.velocity;
    state.impulse.clear();
    for (const IslandPoint& p : columns_.points) state.impulse.push_back(p.impulse);
}

void ExactImpacts::take(const State& state) {
    columns_.velocity = state.velocity;
    for (std::size_t k = 0; k < columns_.points.size(); ++k)
        columns_.points[k].impulse = state.impulse[k];
}

/// Solves what is asked, from the impulses and velocities that there are.
void ExactImpacts::settle() {
    if (solver_.sweep_until(all(), speed_, kFewSweeps)) return;
    keep(before_);
    const double residual = solver_.solve(all(), system_, speed_).residual;
    is_jammed_ = !drivers_.empty() && bears_most();
    if (!is_jammed_ && residual <= kMayMiss * speed_) return;
    take(before_);
    if (!is_jammed_) solver_.sweep_until(all(), speed_, kMostSweeps);
}

/// Whether a contact bears all that it may: then drivers ask for what cannot be.
bool ExactImpacts::bears_most() const {
    return std::any_of(columns_.points.begin(), columns_.points.end(), [](const IslandPoint& p) {
        return p.impulse[0] > kAllButAll * p.cone.most;
    });
}

/// What is jammed is not flung out, nor does it bounce.
void ExactImpacts::hold_back(const Settings& settings) {
    const double share = share_without_flinging(settings, [&](auto visit) {
        for (const Driver& driver : drivers_) visit(driver.own.moving, Vector3d::Zero());
        for (std::size_t i = 0; i < columns_.bodies.size(); ++i)
            visit(columns_.start[i].head<3>(),
                  (columns_.velocity[i] - columns_.start[i]).head<3>());
    });
    for (std::size_t i = 0; i < columns_.bodies.size(); ++i)
        columns_.velocity[i] =
            columns_.start[i] + share * (columns_.velocity[i] - columns_.start[i]);
    for (IslandPoint& p : columns_.points) p.impulse *= share;
}

/// What moves by itself has done to the island [J].
double ExactImpacts::work_of_drivers() const {
    double work = 0;
    for (const Driver& driver : drivers_) work += driver.own.work(columns_.points[driver.point]);
    return work;
}

/// Where friction turns slip about, restitution of several contacts at once can give more energy
/// than there was: then only a share of it is given. `of_compression`: work of drivers [J].
void ExactImpacts::bound_energy(double of_compression) {
    const std::span<const SolvedBody> bodies = columns_.bodies;
    ContactWork work = work_of_change(bodies, compressed_.velocity, columns_.velocity);
    work.at_start -= work_of_drivers() - of_compression;
    const double taken = kinetic_energy(bodies, columns_.start) + of_compression -
                         kinetic_energy(bodies, compressed_.velocity);
    work.granted = std::numeric_limits<double>::infinity();
    const double share = work.share(std::max(0.0, taken));
    if (!(share < 1)) return;
    const auto part = [&](const Vector6d& from, Vector6d& to) { to = from + share * (to - from); };
    for (std::size_t i = 0; i < bodies.size(); ++i)
        part(compressed_.velocity[i], columns_.velocity[i]);
    for (std::size_t k = 0; k < columns_.points.size(); ++k)
        part(compressed_.impulse[k], columns_.points[k].impulse);
}

/// Restitution, after compression. Returns whether there is any.
bool ExactImpacts::give_back(World& world) {
    ContactTable& c = world.contacts;
    if (c.restitution.empty()) return false;
    given_.clear();
    for (std::size_t k = 0; k < columns_.points.size(); ++k) {
        const std::uint32_t contact = columns_.contacts[k];
        IslandPoint& p = columns_.points[k];
        c.set_restitution(contact, 0);
        hit_.push_back(contact);
        const double impulse = restitution(world, contact, p.impulse[0], p.mass_normal);
        if (impulse > 0) given_.push_back({k, impulse});
    }
    std::fill(columns_.sum.begin(), columns_.sum.end(), Vector6d::Zero());
    for (const Given& given : given_) {
        IslandPoint& p = columns_.points[given.point];
        const Vector3d more(given.impulse, 0, 0);
        add_impulse(p, more, columns_.sum);
        p.impulse[0] += given.impulse;
    }
    for (std::size_t i = 0; i < columns_.bodies.size(); ++i)
        columns_.velocity[i] += response(columns_.bodies[i], columns_.sum[i]);
    for (const Given& given : given_) {
        IslandPoint& p = columns_.points[given.point];
        p.wanted[0] = std::max(p.wanted[0], velocity_of(p, columns_.velocity)[0]);
        c.bounced[columns_.contacts[given.point]] = 1;
    }
    return !given_.empty();
}

void ExactImpacts::end(World& world, const Impacts& impacts, ContactSums* sums) const {
    mark_parting(world, hit_);
    if (!sums) return;
    for (const Borne& b : borne_) {
        const double share = impacts.share(b.island);
        sums->add(b.contact, share * b.normal, share * b.friction);
    }
}

}  // namespace plumb
