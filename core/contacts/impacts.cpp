// SPDX-License-Identifier: MIT
#include "contacts/impacts.h"

#include "constraints/connector.h"
#include "contacts/contact_work.h"
#include "world/body_momentum.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// What is farther apart than comes together within a substep at so many times the speed of the
/// fastest collision takes no part in any, where something bounces. What does not comes to rest the
/// sooner the more is swept along with it.
constexpr double kReach = 2;

/// How fast the surfaces of a contact meet within h [m/s], if that is too fast for a contact at
/// rest, else 0. What comes through before it bounces does not meet; nor does what turns with a
/// body, if its arc ends above.
double speed_of_collision(const World& world, std::size_t i, double threshold, double h) {
    const ContactTable& c = world.contacts;
    if (c.is_passing(i)) return 0;
    const double u = separating_velocity(world.bodies, c.found[i], c.point[i]);
    if (!(-u > threshold)) return 0;
    const double arc = c.bend.empty() ? 0 : to_eigen(c.found[i].normal).dot(c.bend[i]);
    return c.gap[i] + h * (u + arc) < 0 ? -u : 0;
}

}  // namespace

void Impacts::reserve(const World& world, const std::vector<BodyPair>& pairs) {
    const auto bodies = static_cast<std::size_t>(world.dynamic_count);
    if (hit_.capacity() >= pairs.size() && changes_.size() == bodies) return;
    hit_.reserve(pairs.size()), near_.reserve(pairs.size()), place_.reserve(pairs.size());
    islands_.find(pairs, {}, 0, world.dynamic_count);
    islands_.reserve(bodies);
    colliding_.reserve(bodies);
    left_.reserve(bodies);
    driven_.reserve(bodies), shares_.reserve(bodies);
    changes_.resize(bodies);
    start_.reserve(world.bodies.size());
    fast_.reserve(world.bodies.size());
}

bool Impacts::find_fast(const Bodies& b, double threshold) {
    const double least = threshold * threshold / 8;
    fast_.resize(b.size());
    bool any = false;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const double squared =
            b.velocity_now[i].squaredNorm() +
            b.bounding_radius[i] * b.bounding_radius[i] * b.angular_velocity_now[i].squaredNorm();
        any |= fast_[i] = squared > least;
    }
    return any;
}

double Impacts::find_hits(const World& world, const std::vector<BodyPair>& pairs, double h) {
    const double threshold = resting_speed(world.settings, h);
    double fastest = 0;
    hit_.assign(pairs.size(), 0);
    if (!find_fast(world.bodies, threshold)) return 0;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const Contact& contact = world.contacts.found[pairs[p].first];
        if (!fast_[contact.a] && !fast_[contact.b]) continue;
        for (std::uint32_t k = 0; k < pairs[p].count; ++k) {
            const double speed = speed_of_collision(world, pairs[p].first + k, threshold, h);
            if (speed > 0) hit_[p] = 1;
            fastest = std::max(fastest, speed);
        }
    }
    return fastest;
}

void Impacts::find_near(const World& world, const std::vector<BodyPair>& pairs, double reach) {
    const auto is_within = [&](const BodyPair& pair) {
        if (reach >= kOutOfReach) return true;
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            if (gap_in_substep(world.contacts, k) <= reach) return true;
        return false;
    };
    near_.clear(), place_.clear();
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        if (!hit_[p] && !is_within(pairs[p])) continue;
        near_.push_back(pairs[p]);
        place_.push_back(static_cast<std::uint32_t>(p));
    }
}

bool Impacts::find(const World& world, const std::vector<BodyPair>& pairs, double h) {
    colliding_.clear();
    const double fastest = find_hits(world, pairs, h);
    if (fastest == 0) return false;
    const bool bounces = !world.contacts.restitution.empty();
    find_near(world, pairs, bounces ? kReach * h * fastest : kOutOfReach);

    islands_.find(near_, {}, 0, world.dynamic_count);
    for (const ContactIsland& island : islands_.islands()) {
        bool hit = false;
        each_pair(island, [&](std::size_t pair) { hit |= hit_[pair] != 0; });
        if (!hit) continue;
        each_pair(island, [&](std::size_t pair) { hit_[pair] = 1; });
        colliding_.push_back(island);
    }
    left_.assign(colliding_.size(), 0), driven_.assign(colliding_.size(), 0);
    choose_start(world);
    return true;
}

std::size_t Impacts::swept_pairs() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < colliding_.size(); ++i)
        if (!left_[i]) count += colliding_[i].last_pair - colliding_[i].first_pair;
    return count;
}

void Impacts::leave(std::size_t island) {
    left_[island] = 1;
    each_pair(colliding_[island], [&](std::size_t pair) { hit_[pair] = 0; });
}

void Impacts::choose_start(const World& world) {
    const Bodies& b = world.bodies;
    start_ = b.velocity_now;
    for (const ContactIsland& island : colliding_) {
        if (island.last_pair - island.first_pair > 1) continue;
        for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
            const std::uint32_t body = world.body_of_row[islands_.bodies()[i]];
            start_[body] = 0.5 * (b.velocity_now[body] + b.velocity[body]);
        }
    }
}

void Impacts::add_work(const World& world, std::size_t island, std::size_t contact,
                       const Vector3d& impulse) {
    const Bodies& b = world.bodies;
    const Contact& c = world.contacts.found[contact];
    const auto add = [&](std::uint32_t body, double sign) {
        if (b.motion[body] != Motion::kinematic) return;
        const Vector3d arm = world.contacts.point[contact] - b.position[body];
        const Vector3d u = velocity_at<double>({start_[body], b.angular_velocity_now[body]}, arm);
        add_work(island, sign * impulse.dot(u));
    };
    add(c.a, -1), add(c.b, 1);
}

/// The greatest share of the changes, at most 1, with which the island has no more energy than
/// before and than was done to it.
double Impacts::bounded_share(const World& world, std::size_t which) const {
    const ContactIsland& island = colliding_[which];
    const Bodies& bodies = world.bodies;
    ContactWork work;
    work.at_start = -driven_[which];
    for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
        const std::int32_t row = islands_.bodies()[i];
        const std::uint32_t body = world.body_of_row[row];
        const Change& d = changes_[row];
        const Vector3d &v = start_[body], &w = bodies.angular_velocity_now[body];
        work.at_start += bodies.mass[body] * v.dot(d.v) + inertia_product(bodies, body, w, d.w);
        work.of_change += kinetic_energy(bodies, body, d.v, d.w);
    }
    return work.share(0);
}

/// The velocity that roundings of single precision have given an island which touches nothing that
/// is immovable: impulses leave its momentum as it is.
Vector3d Impacts::drift(const World& world, const ContactIsland& island) const {
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const BodyPair& pair = near_[islands_.pairs()[i]];
        if (std::max(pair.row_a, pair.row_b) >= world.dynamic_count) return Vector3d::Zero();
    }
    Vector3d momentum = Vector3d::Zero();
    double mass = 0;
    for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
        const std::int32_t row = islands_.bodies()[i];
        const double of_body = world.bodies.mass[world.body_of_row[row]];
        momentum += of_body * changes_[row].v, mass += of_body;
    }
    return momentum / mass;
}

void Impacts::take(World& world, double h) {
    Bodies& b = world.bodies;
    shares_.clear();
    for (std::size_t which = 0; which < colliding_.size(); ++which) {
        const ContactIsland& island = colliding_[which];
        const double share = shares_.emplace_back(bounded_share(world, which));
        const Vector3d drifted = drift(world, island);
        for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
            const std::int32_t row = islands_.bodies()[i];
            const std::uint32_t body = world.body_of_row[row];
            const Vector3d dv = share * (changes_[row].v - drifted), dw = share * changes_[row].w;
            b.velocity[body] += dv, b.velocity_now[body] += dv;
            if (gyroscopic_ && !b.isotropic[body])
                b.angular_velocity[body] = pushed_rate(b, body, dw, h);
            else
                b.angular_velocity[body] += dw;
            b.angular_velocity_now[body] += dw;
            b.angular_momentum[body] += spin_momentum(b, body, dw);
        }
    }
}

double restitution(const World& world, std::size_t contact, double lambda, double mass) {
    const Contact& found = world.contacts.found[contact];
    const bool collides = lambda > collision_threshold(world.settings) * mass;
    if (!collides || is_open(world, contact)) return 0;
    return world.surface_pair(found.a, found.b).restitution * lambda;
}

void mark_parting(World& world, const std::vector<std::size_t>& contacts) {
    ContactTable& c = world.contacts;
    for (const std::size_t i : contacts)
        if (separating_velocity(world.bodies, c.found[i], c.point[i]) > 0)
            c.set_restitution(i, ContactTable::kParting);
}

}  // namespace plumb
