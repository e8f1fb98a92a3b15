// SPDX-License-Identifier: MIT
#include "solve/elastic_factors.h"

#include "kernels/front_kernels.h"
#include "math/growing.h"
#include "solve/contact_stiffness.h"

#include <algorithm>

namespace plumb {
namespace {

/// Of attached rows that have blocks with each other; for more of them memory grows as it must.
constexpr std::size_t kManyRows = 128;

/// Pairs that touched before are kept up to so many times those that touch now.
constexpr std::size_t kKeepNear = 3;

}  // namespace

ElasticFactors::ElasticFactors(const World& world, const ElasticParts& parts)
    : system_(front_kernels()), places_(parts.particles(), Vector3d::Zero()) {
    for (const auto& elements : parts.elements) elements->add_pairs(particle_pairs_);
    for (const Link& link : world.links)
        if (link.is_between_particles())
            particle_pairs_.emplace_back(link.a.particle, link.b.particle);
    own_pairs_ = particle_pairs_.size();
    parts.balloons.add_pairs(parts.first_balloon_row(), pairs_);
    balloon_pairs_ = pairs_.size();
    order(parts);
}

/// With those that touch, by made_of_.
void ElasticFactors::order(const ElasticParts& parts) {
    copy_anew(near_, made_of_.near);
    particle_pairs_.resize(own_pairs_);
    append(particle_pairs_, near_);
    system_.order(parts.particles(), particle_pairs_);
    for (const auto& elements : parts.elements) elements->find_slots(system_);
    pairs_.resize(balloon_pairs_);
    contact_pairs_.clear();
    system_.attach(parts.balloons.rows(), pairs_);
}

/// Particles of different surfaces, or far apart on one, that touch now. Those that touched before
/// stay, as long as they are not many more: they come and go.
void ElasticFactors::take_near(const ElasticParts& parts) {
    bool known = true;
    near_now_.clear();
    for (const ElasticContacts::Contact& c : parts.contacts.contacts())
        for (std::uint32_t k = 0; k < c.points; ++k)
            for (std::uint32_t l = 0; l < k; ++l) {
                const auto [low, high] = std::minmax(c.particle[k], c.particle[l]);
                known = known && system_.find_slot(low, high);
                near_now_.emplace_back(low, high);
            }
    if (known) return;
    if (made_of_.near.size() <= kKeepNear * near_now_.size())
        append(near_now_, made_of_.near);
    else
        drop();  // they are of pairs that have no blocks any more
    std::sort(near_now_.begin(), near_now_.end());
    near_now_.erase(std::unique(near_now_.begin(), near_now_.end()), near_now_.end());
    copy_anew(made_of_.near, near_now_);
}

/// Memory for as many attached rows and pairs as there may be.
void ElasticFactors::reserve(const ElasticParts& parts) {
    system_.reserve_attached(std::min(parts.most_rows() - parts.particles(), kManyRows));
    const std::size_t most_contacts = parts.contacts.contacts().capacity(),
                      most_ties = parts.ties.points().size();
    made_of_.bodies.reserve(parts.contacts.bodies().capacity());
    made_of_.contacts.reserve(most_contacts);
    for (auto* pairs : {&pairs_, &contact_pairs_, &pairs_now_})
        pairs->reserve(balloon_pairs_ + 6 * most_contacts + 12 * most_ties);
}

void ElasticFactors::begin_step(const World& world, ElasticParts& parts, double h) {
    reserve(parts);
    made_ = 0;
    if (world.kept_factors != made_of_) {
        exist_ = false;
        made_of_ = world.kept_factors;
    }
    const std::size_t n = parts.particles();
    take_near(parts);
    if (made_of_.near != near_) {
        order(parts);
        exist_ = false;
    }
    if (made_of_.places.size() != n || made_of_.before.size() != n ||
        !parts.contacts.has_bodies_of(made_of_))
        drop();
    if (exist_) return;
    if (!made_of_.places.empty()) {
        for (const auto& elements : parts.elements) elements->begin(made_of_.places, h);
        make_again(parts, h);
    } else if (!parts.contacts.empty()) {
        const std::vector<Vector3d>& at = world.particles.position;
        for (std::size_t i = 0; i < n; ++i) places_[i] = at[i] - at[0];
        for (const auto& elements : parts.elements) elements->begin(places_, h);
        assemble_elements(parts, places_, places_, h);
        parts.contacts.weigh(system_);
    }
}

/// Where one set of factors did not do for a step, the last does not for the next one.
void ElasticFactors::store(World& world) {
    if (made_ > 1) drop();
    if (world.kept_factors == made_of_) return;
    KeptFactors& kept = world.kept_factors;
    kept.contacts.reserve(made_of_.contacts.capacity());
    kept.bodies.reserve(made_of_.bodies.capacity());
    make_room(kept.near, made_of_.near.size());
    make_room(kept.rows, made_of_.rows.size());
    kept = made_of_;
}

bool ElasticFactors::make(ElasticParts& parts, const ParticlePlaces& x,
                          const ParticlePlaces& before, double h) {
    made_of_.places = x, made_of_.before = before;
    parts.contacts.list_stiffness(made_of_);
    parts.ties.list_stiffness(made_of_);
    ++made_;
    return make_again(parts, h);
}

/// Of what they are made of.
bool ElasticFactors::make_again(ElasticParts& parts, double h) {
    attach_contacts(parts);
    assemble_elements(parts, made_of_.places, made_of_.before, h);
    if (parts.may_have_bodies) parts.contacts.weigh(system_);
    parts.balloons.add_stiffness(made_of_.places, parts.mass, h, parts.first_balloon_row(),
                                 system_);
    add_contact_stiffness(made_of_, parts.mass, parts.first_body_row(), contact_pairs_,
                          balloon_pairs_, system_);
    exist_ = system_.factor();
    if (!exist_) drop();
    return exist_;
}

/// Only what pushes has blocks: most of what is near does not touch.
void ElasticFactors::attach_contacts(const ElasticParts& parts) {
    pairs_now_.clear();
    list_pairs(made_of_, parts.first_body_row(), pairs_now_);
    const std::uint32_t rows =
        parts.balloons.rows() + 2 * static_cast<std::uint32_t>(made_of_.bodies.size());
    if (rows == system_.more() && pairs_now_ == contact_pairs_) return;
    std::swap(pairs_now_, contact_pairs_);
    pairs_.resize(balloon_pairs_);
    append(pairs_, contact_pairs_);
    system_.attach(rows, pairs_);
}

void ElasticFactors::assemble_elements(const ElasticParts& parts, const ParticlePlaces& x,
                                       const ParticlePlaces& before, double h) {
    system_.clear();
    for (std::uint32_t i = 0; i < parts.particles(); ++i)
        system_.add(i, (parts.mass[i] > 0 ? parts.mass[i] : 1) * Matrix3d::Identity());
    for (const auto& elements : parts.elements) elements->add_stiffness(x, before, h * h, system_);
}

void ElasticFactors::drop() {
    exist_ = false;
    made_of_.drop();
}

}  // namespace plumb
