// SPDX-License-Identifier: MIT
#include "islands/island_demands.h"

#include "constraints/substep_time.h"
#include "contacts/contact_measures.h"
#include "islands/own_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

/// A contact bears at most this many times the weight of its island (wedges and flat arches thrust
/// by more than they weigh), and this many times its momentum.
constexpr double kThrust = 100, kBlow = 10;

/// An overlap that sticks is left as it is from when the contact bears more than this share of the
/// most it may: each substep's push would only wind up the stress that locks them.
constexpr double kLocked = 0.1;

/// A joint may bear so many times more: levers and toggles multiply what they bear.
constexpr double kLever = 100;

/// Bodies that fly about and overlap part at least at this share of their radius [1/s].
constexpr double kDrift = 0.3;

/// Of a driven axis, as far as its bounds or the substep before tell.
double greatest_impulse(const TieRow& row) {
    double most = std::abs(row.impulse);
    for (int i = 0; i < row.drive->n; ++i)
        for (const double bound : {row.drive->rows[i].lowest, row.drive->rows[i].highest})
            if (std::isfinite(bound)) most = std::max(most, std::abs(bound));
    return most;
}

}  // namespace

std::uint32_t IslandDemands::ask(ExactIsland& island) {
    TieRows& ties = columns_.ties;
    island.was_open = open_at_start(island) > kAjar * world_.settings.joint_tolerance;
    island.was_torn = ties.open_at_start(island.ties) > torn_from(island);
    ties.ask(island.ties, bodies_in(columns_.velocity, island));
    island.speed = speed_of(island);
    const double most = strongest(island);
    bound_rows(island, most);
    island.parts = island.bounces = false;
    std::uint32_t clamped = 0;
    for (std::uint32_t k = island.first_point; k < island.last_point; ++k) {
        columns_.points[k].cone.most = most;
        clamped += ask(island, k);
        island.parts |= island.gains_nothing && columns_.parting[k] > 0;
        island.bounces |= restitution_velocity_of(world_.contacts, columns_.contacts[k]) > 0;
    }
    return clamped;
}

/// By how much the worst tie is open that is to be closed [m], [rad].
double IslandDemands::open_at_start(const ExactIsland& island) {
    if (!island.is_meshed) return 0;
    const std::span<Vector6d> rest = bodies_in(columns_.sum, island);
    std::fill(rest.begin(), rest.end(), Vector6d::Zero());
    return columns_.ties.ask_to_close(island.ties, rest);
}

/// From how far open on a joint is torn: farther than it may close in a substep. A driven island
/// that was iterated, as large ones are while they move fast, may be open by up to its smallest
/// body's radius [m].
double IslandDemands::torn_from(const ExactIsland& island) const {
    if (!island.is_driven || island.body_count() <= kVerySmall)
        return h_ * world_.settings.recovery_speed;
    double least = std::numeric_limits<double>::infinity();
    for (const SolvedBody& body : bodies_in(columns_.bodies, island))
        least = std::min(least, world_.bodies.bounding_radius[body.body]);
    return least;
}

/// How fast contacts approach or part, and joints open, if nothing pushes, or how fast an overlap
/// shall go [m/s].
double IslandDemands::speed_of(const ExactIsland& island) const {
    const ContactTable& c = world_.contacts;
    double speed = 0;
    for (const std::uint32_t contact : points_in(columns_.contacts, island)) {
        const double overlap = std::min(c.gap[contact], 0.0);
        const double normal =
            to_eigen(c.found[contact].normal).dot(relative_velocity(world_, contact));
        speed = std::max({speed, std::abs(normal), closing_velocity(overlap)});
    }
    const std::span<const Vector6d> start = bodies_in(columns_.start, island);
    for (const TieRow& row : columns_.ties.rows(island.ties)) {
        TieRow bare = row;
        bare.impulse = 0, bare.most = std::numeric_limits<double>::infinity();
        const double asked = answer_of(bare, rate_of(row, start), row.mass).impulse;
        speed = std::max(speed, row.length * std::abs(asked) / row.mass);
    }
    return speed;
}

/// The most that its bodies' weight and speed give an island in a substep [N s].
double IslandDemands::thrust_of(const ExactIsland& island) const {
    double thrust = 0;
    for (const SolvedBody& body : bodies_in(columns_.bodies, island))
        thrust += body.mass * std::max(h_ * pull_on(world_, body.body), island.speed);
    return thrust;
}

/// More than any contact bears that can be satisfied [N s]; motors push as hard as they can.
double IslandDemands::strongest(const ExactIsland& island) const {
    double mass = 0, weight = 0, driven = 0;
    for (const SolvedBody& body : bodies_in(columns_.bodies, island)) {
        mass += body.mass;
        weight += body.mass * pull_on(world_, body.body);
    }
    for (const TieRow& row : columns_.ties.rows(island.ties))
        if (row.drive) driven += greatest_impulse(row) / row.length;
    return kThrust * weight * h_ + kBlow * mass * island.speed + kBlow * driven;
}

/// What the rows of ties may bear; rigid ones yield by what they may be open under its thrust.
void IslandDemands::bound_rows(const ExactIsland& island, double most) {
    const double thrust = thrust_of(island);
    for (TieRow& row : columns_.ties.rows(island.ties)) {
        row.most = kLever * most * row.length;
        row.is_rigid = row.softness == 0;
        if (row.is_rigid && thrust > 0)
            row.softness =
                world_.settings.joint_tolerance / (h_ * thrust * row.length * row.length);
    }
}

/// What the substep asks of a point, and whether that leaves some of its overlap.
bool IslandDemands::ask(const ExactIsland& island, std::size_t k) {
    const ContactTable& c = world_.contacts;
    const std::uint32_t contact = columns_.contacts[k];
    IslandPoint& p = columns_.points[k];
    const double gap = gap_to_solve_for(world_, contact, push_out_.most);
    const double normal = asked_along(island, k, gap);
    const Bodies& b = world_.bodies;
    OwnMotion own(world_, p, contact, b.velocity, b.angular_velocity);
    if (!c.bend.empty()) own.moving += c.bend[contact];
    p.wanted << asked_across(island, k), Vector3d::Zero();
    p.wanted[0] += normal;
    own.take_from(p);
    return is_clamped(c.gap[contact], gap, push_out_.most);
}

/// Whether overlap and slip are left as they are.
bool IslandDemands::stays(const ExactIsland& island) {
    return island.splits || island.effort == IslandEffort::light;
}

/// Velocity along the normal [m/s]; of creep it is 0. `gap`: to be solved [m].
double IslandDemands::asked_along(const ExactIsland& island, std::size_t k, double gap) {
    const ContactTable& c = world_.contacts;
    const std::uint32_t contact = columns_.contacts[k];
    const IslandPoint& p = columns_.points[k];
    const double bounce = restitution_velocity_of(c, contact);
    const ContactMemory& before = c.memory[contact];
    const bool locked = choice_.is_stuck(before, -c.found[contact].gap) &&
                        (before.jammed || p.impulse[0] > kLocked * p.cone.most);
    double normal = closing_velocity(gap);
    if (std::abs(normal) < kCreep * island.speed || (locked && normal > 0)) normal = 0;
    columns_.locked[k] = locked;
    columns_.opening[k] = island.splits && bounce == 0 ? std::max(0.0, normal) : 0;
    if (stays(island) && normal > 0) normal = 0;
    if (bounce > 0) normal = bounce;

    double& parting = columns_.parting[k];
    parting = bounce > ContactTable::kParting ? bounce : 0;
    if (island.flies && bounce == 0)
        parting = std::max(0.0, normal - kDrift * smaller_radius(world_.bodies, c.found[contact]));
    return normal;
}

/// Velocity that takes slip back [m/s], in the frame of the point; of creep it is 0.
Vector3d IslandDemands::asked_across(const ExactIsland& island, std::size_t k) const {
    const std::vector<Vector3d>& slip = world_.contacts.anchor_slip;
    if (slip.empty() || stays(island)) return Vector3d::Zero();
    const double stiffness = world_.settings.anchor_stiffness / h_;
    Vector3d across =
        columns_.points[k].frame.transpose() * (-stiffness * slip[columns_.contacts[k]]);
    across[0] = 0;
    if (across.cwiseAbs().maxCoeff() < kCreep * island.speed) across.setZero();
    return across;
}

/// Velocity along the normal that makes the gap what it shall be at the end of the substep [m/s].
double IslandDemands::closing_velocity(double gap) const {
    const double left = overlap_left(gap, push_out_.most);
    return -gap_below(gap - left, std::min(gap, 0.0) - left, push_out_.share) / h_;
}

}  // namespace plumb
