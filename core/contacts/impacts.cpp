// SPDX-License-Identifier: MIT
#include "contacts/impacts.h"

#include "contacts/contact_work.h"
#include "world/body_momentum.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Whether the surfaces of a contact meet within h, too fast to be a contact at rest. What comes
/// through before it bounces does not; nor does what turns with a body, if its arc ends above.
bool collides(const World& world, std::size_t i, double threshold, double h) {
    const ContactTable& c = world.contacts;
    if (c.is_passing(i)) return false;
    const double u = separating_velocity(world.bodies, c.found[i], c.point[i]);
    if (!(-u > threshold)) return false;
    const double arc = c.bend.empty() ? 0 : to_eigen(c.found[i].normal).dot(c.bend[i]);
    return c.gap[i] + h * (u + arc) < 0;
}

}  // namespace

void Impacts::reserve(const World& world, const std::vector<BodyPair>& pairs) {
    const auto bodies = static_cast<std::size_t>(world.dynamic_count);
    if (hit_.capacity() >= pairs.size() && changes_.size() == bodies) return;
    hit_.reserve(pairs.size());
    islands_.find(pairs, {}, 0, world.dynamic_count);
    colliding_.reserve(bodies);
    left_.reserve(bodies);
    shares_.reserve(bodies);
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

bool Impacts::find(const World& world, const std::vector<BodyPair>& pairs, double h) {
    colliding_.clear();
    const double threshold = resting_speed(world.settings, h);
    if (!find_fast(world.bodies, threshold)) return false;
    hit_.assign(pairs.size(), 0);
    bool any = false;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const Contact& contact = world.contacts.found[pairs[p].first];
        if (!fast_[contact.a] && !fast_[contact.b]) continue;
        for (std::uint32_t k = 0; k < pairs[p].count && !hit_[p]; ++k)
            any |= hit_[p] = collides(world, pairs[p].first + k, threshold, h);
    }
    if (!any) return false;

    islands_.find(pairs, {}, 0, world.dynamic_count);
    for (const ContactIsland& island : islands_.islands()) {
        const auto first = islands_.pairs().begin() + island.first_pair,
                   last = islands_.pairs().begin() + island.last_pair;
        const bool hit = std::any_of(first, last, [&](std::uint32_t p) { return hit_[p] != 0; });
        if (!hit) continue;
        std::for_each(first, last, [&](std::uint32_t p) { hit_[p] = 1; });
        colliding_.push_back(island);
    }
    left_.assign(colliding_.size(), 0);
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
    for (std::uint32_t p = colliding_[island].first_pair; p < colliding_[island].last_pair; ++p)
        hit_[islands_.pairs()[p]] = 0;
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

bool Impacts::is_driven(const World& world, const ContactIsland& island,
                        const std::vector<BodyPair>& pairs) const {
    const auto moves = [&](std::int32_t row) {
        return row >= world.dynamic_count && row != world.zero_row();
    };
    const auto first = islands_.pairs().begin();
    return std::any_of(first + island.first_pair, first + island.last_pair, [&](std::uint32_t p) {
        return moves(pairs[p].row_a) || moves(pairs[p].row_b);
    });
}

/// The greatest share of the changes, at most 1, with which the island has no more energy than
/// before. What moves by itself may add energy.
double Impacts::bounded_share(const World& world, const ContactIsland& island,
                              const std::vector<BodyPair>& pairs) const {
    if (is_driven(world, island, pairs)) return 1;
    const Bodies& bodies = world.bodies;
    ContactWork work;
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
Vector3d Impacts::drift(const World& world, const ContactIsland& island,
                        const std::vector<BodyPair>& pairs) const {
    for (std::uint32_t i = island.first_pair; i < island.last_pair; ++i) {
        const BodyPair& pair = pairs[islands_.pairs()[i]];
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

void Impacts::take(World& world, const std::vector<BodyPair>& pairs, double h) {
    Bodies& b = world.bodies;
    shares_.clear();
    for (const ContactIsland& island : colliding_) {
        const double share = shares_.emplace_back(bounded_share(world, island, pairs));
        const Vector3d drifted = drift(world, island, pairs);
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
