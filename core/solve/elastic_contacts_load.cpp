// SPDX-License-Identifier: MIT
/// Which contacts are part of the elastic system, once a step.
#include "contacts/contact_measures.h"
#include "math/fnv1a.h"
#include "solve/elastic_contacts.h"

#include <algorithm>
#include <tuple>

namespace plumb {
namespace {

/// Bodies of the system have blocks with each other in the factors. Where more than this touch each
/// other on a sheet, only those that touch it are part of the system, each by itself.
constexpr std::uint32_t kMostBodies = 64;

/// What moves on by less than this share of its radius in a step does not collide, however small
/// gravity is.
constexpr double kSlow = 0.01;

/// What overlaps by more than this share of its radius may be wedged, with no way out that all of
/// it finds at once: its impulses would wind up.
constexpr double kDeep = 0.1;

/// What collides is brought to rest as such; what is deep, is moved by others or resists rolling is
/// iterated.
bool belongs(const World& world, const BodyPair& pair) {
    const Bodies& b = world.bodies;
    const Contact& first = world.contacts.found[pair.first];
    if (b.motion[first.a] == Motion::kinematic || b.motion[first.b] == Motion::kinematic)
        return false;
    const SurfacePair& surface = world.surface_pair(first.a, first.b);
    if (surface.rolling_friction > 0 || surface.spinning_friction > 0) return false;
    const double radius = smaller_radius(b, first);
    const double fast =
        std::max(collision_threshold(world.settings), kSlow * radius / world.settings.dt);
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
        const plumb::Contact& c = world.contacts.found[i];
        if (separating_velocity(b, c, world.contacts.point[i]) < -fast) return false;
        if (-c.gap > kDeep * radius) return false;
    }
    return true;
}

bool is_of_particles(const World& world, const Tie& tie) {
    return tie.kind == TieKind::link && !world.links[tie.index].is_between_bodies();
}

/// By what a contact is known from step to step.
ElasticImpulse key_of(const World& world, const ElasticContacts::Contact& c, std::uint32_t order) {
    ElasticImpulse key{
        {c.particle[0], kNoIndex, kNoIndex}, c.sides[1].index, 0, 0, order, {0, 0, 0}};
    if (c.of == ElasticContacts::Source::surface) {
        key.particles = {c.particle[0], c.particle[1], c.particle[2]};
        const Vector3d& point = world.surface_contacts[c.source].point.position;
        Fnv1a hash;
        hash.add(point.data(), 3 * sizeof(double));
        key.feature = hash.value();
        if (c.is_between_particles()) key.part = c.particle[3];
    } else {
        const plumb::Contact& found = world.particle_contacts.found[c.source];
        key.part = found.part_b, key.feature = found.feature;
    }
    return key;
}

/// Body and particle, body and the body's point, or the particle that touches a triangle.
std::tuple<std::uint32_t, std::uint32_t, std::uint64_t> spot_of(const ElasticImpulse& x) {
    if (x.body == kNoIndex) return {kNoIndex, x.part, 0};
    const bool is_particle = x.particles[1] == kNoIndex;
    return {x.body, is_particle ? x.particles[0] : kNoIndex, is_particle ? 0 : x.feature};
}

using References = std::vector<const ElasticImpulse*>;

void list(const std::vector<ElasticImpulse>& all, References& references) {
    references.clear();
    references.reserve(all.capacity());
    for (const ElasticImpulse& x : all) references.push_back(&x);
}

/// Of two lists sorted by `key`, calls take(x, y) for those with the same one, in their order, and
/// leaves the others.
template <class Key, class Take>
void pair_off(References& now, References& before, Key key, Take take) {
    auto x = now.begin(), x_left = x;
    auto y = before.begin(), y_left = y;
    while (x != now.end() && y != before.end()) {
        if (key(**x) < key(**y))
            *x_left++ = *x++;
        else if (key(**y) < key(**x))
            *y_left++ = *y++;
        else
            take(**x++, **y++);
    }
    now.erase(x_left, x), before.erase(y_left, y);
}

}  // namespace

ElasticContacts::ElasticContacts(const Plan& plan)
    : has_friction_(plan.runs(Effect::friction)),
      touches_(has_elastic_contacts(plan)),
      takes_bodies_(plan.runs(Effect::exact_islands) && !plan.runs(Effect::shock_propagation)) {}

void ElasticContacts::load(const World& world, std::uint32_t first_row,
                           std::vector<BodyPair>& pairs, ElasticTies& ties) {
    first_row_ = first_row;
    bodies_.clear(), contacts_.clear();
    contacts_.reserve(world.particle_contacts.found.capacity() + world.surface_contacts.capacity() +
                      world.contacts.found.capacity());
    bodies_.reserve(world.bodies.size());
    body_of_.assign(world.bodies.size(), kNoIndex);
    if (touches_) add_contacts_of_particles(world);
    add_linked_bodies(world);
    is_member_.assign(world.bodies.size(), 0);
    const std::vector<Tie>& found = ties.find(world, takes_bodies_);
    if (takes_bodies_ && !bodies_.empty()) take_bodies(world, pairs, found);
    take_ties(world, found, ties);
    take_kept(world);
}

void ElasticContacts::add_linked_bodies(const World& world) {
    for (const Link& link : world.links)
        if (!link.is_between_bodies())
            for (const WorldPoint* p : {&link.a, &link.b})
                if (p->body != kNoIndex) body_of(world, p->body);
}

std::uint32_t ElasticContacts::body_of(const World& world, std::uint32_t body) {
    if (!(world.bodies.inverse_mass[body] > 0)) return kNoIndex;
    if (body_of_[body] == kNoIndex) {
        Body added;
        added.index = body, added.row = first_row_ + rows();
        body_of_[body] = static_cast<std::uint32_t>(bodies_.size());
        bodies_.push_back(added);
    }
    return body_of_[body];
}

void ElasticContacts::add(const World& world, Contact& c, std::uint32_t a, std::uint32_t b) {
    double moves = 0;
    for (std::uint32_t k = 0; k < c.points; ++k)
        moves += world.particles.inverse_mass[c.particle[k]];
    if (a != kNoIndex) c.sides[0].index = a, c.sides[0].body = body_of(world, a);
    if (b != kNoIndex) c.sides[1].index = b, c.sides[1].body = body_of(world, b);
    if (!(moves > 0) && c.sides[0].body == kNoIndex && c.sides[1].body == kNoIndex) return;
    if (!has_friction_) c.friction = 0;
    contacts_.push_back(c);
}

void ElasticContacts::add_contacts_of_particles(const World& world) {
    const ParticleContactTable& table = world.particle_contacts;
    for (std::uint32_t i = 0; i < table.found.size(); ++i) {
        const plumb::Contact& found = table.found[i];
        Contact c;
        c.of = Source::particle, c.source = i;
        c.points = 1, c.particle[0] = found.a;
        c.normal = to_eigen(found.normal);
        c.friction =
            world.surface_of(world.particles.material[found.a], world.bodies.material[found.b])
                .friction;
        add(world, c, kNoIndex, found.b);
    }
    for (std::uint32_t i = 0; i < world.surface_contacts.size(); ++i) {
        const SurfaceContact& found = world.surface_contacts[i];
        const bool is_of_body = found.point.body != kNoIndex;
        Contact c;
        c.of = Source::surface, c.source = i, c.points = is_of_body ? 3 : 4;
        for (int k = 0; k < 3; ++k) {
            c.particle[k] = found.triangle[k];
            c.weight[k] = is_of_body ? found.weights[k] : -found.weights[k];
        }
        if (!is_of_body) c.particle[3] = found.point.particle, c.weight[3] = 1;
        c.normal = is_of_body ? Vector3d(-found.normal) : found.normal;
        c.friction = found.friction;
        add(world, c, kNoIndex, found.point.body);
    }
}

/// What lies on or beside a body that touches a sheet belongs to it, and what is tied to it.
void ElasticContacts::find_members(const World& world, const std::vector<BodyPair>& pairs,
                                   const std::vector<Tie>& ties) {
    const std::size_t n = world.bodies.size();
    groups_.reset(n), members_.assign(n, 0);
    const auto moves = [&](std::uint32_t i) { return world.bodies.inverse_mass[i] > 0; };
    belongs_.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const plumb::Contact& c = world.contacts.found[pairs[i].first];
        belongs_[i] = belongs(world, pairs[i]);
        if (moves(c.a) && moves(c.b) && belongs_[i]) groups_.unite(c.a, c.b);
    }
    for (const Tie& tie : ties) unite_bodies(world, tie, groups_);
    for (std::uint32_t i = 0; i < n; ++i) ++members_[groups_.lowest(i)];
    const std::uint32_t most = std::min(kMostBodies, world.settings.exact_islands);
    for (const Body& body : bodies_) is_member_[groups_.lowest(body.index)] = 1;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t group = groups_.lowest(i);
        is_member_[i] = is_member_[group] && members_[group] <= most;
    }
}

bool ElasticContacts::is_member(const World& world, std::uint32_t body) const {
    return body != kNoIndex && world.bodies.inverse_mass[body] > 0 && is_member_[body] != 0;
}

void ElasticContacts::take_bodies(const World& world, std::vector<BodyPair>& pairs,
                                  const std::vector<Tie>& ties) {
    find_members(world, pairs, ties);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const BodyPair pair = pairs[i];
        const plumb::Contact& first = world.contacts.found[pair.first];
        if ((is_member(world, first.a) || is_member(world, first.b)) && belongs_[i]) {
            for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k) {
                Contact c;
                c.of = Source::bodies, c.source = k;
                c.normal = to_eigen(world.contacts.found[k].normal);
                c.friction = world.surface_pair(first.a, first.b).friction;
                add(world, c, first.a, first.b);
            }
        } else {
            pairs[kept++] = pair;
        }
    }
    pairs.resize(kept);
}

/// Of bodies those that are members; and all links with particles.
void ElasticContacts::take_ties(const World& world, const std::vector<Tie>& found,
                                ElasticTies& ties) {
    const auto is_taken = [&](const Tie& tie) {
        bool taken = is_of_particles(world, tie);
        each_body(world, tie, [&](std::uint32_t body) { taken |= is_member(world, body); });
        return taken;
    };
    const auto each_taken = [&](auto visit) {
        for (const Tie& tie : found)
            if (is_taken(tie)) visit(tie);
    };
    each_taken([&](const Tie& tie) {
        each_body(world, tie, [&](std::uint32_t body) {
            if (is_member(world, body)) body_of(world, body);
        });
    });
    ties.clear(static_cast<std::uint32_t>(bodies_.size()));
    each_taken([&](const Tie& tie) {
        TiedBodies at;
        at.fill(kImmovable);
        std::size_t i = 0;
        each_body(world, tie, [&](std::uint32_t body) {
            if (is_member(world, body) || (body != kNoIndex && is_of_particles(world, tie)))
                at[i] = body_of(world, body);
            ++i;
        });
        ties.add(world, tie, at);
    });
}

/// p of what touched in the step before. A point that has come to lie on the next triangle, or a
/// particle on the next side of a body, takes its impulse along.
void ElasticContacts::take_kept(const World& world) {
    keys_.clear();
    keys_.reserve(contacts_.capacity());
    for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
        Contact& c = contacts_[i];
        if (c.of == Source::bodies) {
            const ContactMemory& memory = world.contacts.memory[c.source];
            if (world.settings.warm_start && memory.matched)
                c.p = memory.normal_impulse * c.normal + memory.friction_impulse;
        } else {
            keys_.push_back(key_of(world, c, i));
        }
    }
    std::sort(keys_.begin(), keys_.end());
    list(keys_, now_), list(world.elastic_impulses, before_);
    const auto take = [&](const ElasticImpulse& now, const ElasticImpulse& kept) {
        contacts_[now.order].p = kept.impulse;
    };
    pair_off(
        now_, before_, [](const ElasticImpulse& x) { return x.key(); }, take);
    const auto by_place = [](const ElasticImpulse* x, const ElasticImpulse* y) {
        return std::tuple(spot_of(*x), x->order) < std::tuple(spot_of(*y), y->order);
    };
    std::sort(now_.begin(), now_.end(), by_place);
    std::sort(before_.begin(), before_.end(), by_place);
    pair_off(now_, before_, spot_of, take);
}

}  // namespace plumb
