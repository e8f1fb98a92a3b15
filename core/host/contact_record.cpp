// SPDX-License-Identifier: MIT
#include "host/contact_record.h"

#include <algorithm>

namespace plumb {
namespace {

using Pair = ContactRecord::Pair;

Pair pair_of(const BodyContact& c) { return {c.body_a, c.body_b}; }

/// Where a point is now that rode on a body since it was at `then`.
Vector3d ridden(const Bodies& b, std::uint32_t body, const Pose& then, const Vector3d& point) {
    if (b.motion[body] == Motion::fixed) return point;
    const Vector3d local = to_eigen(then.rotation).conjugate() * (point - to_eigen(then.position));
    return in_world(b, body, local);
}

/// Puts the body of the lower identifier first.
void put_in_order(BodyContact& c) {
    if (c.body_a < c.body_b) return;
    std::swap(c.body_a, c.body_b);
    std::swap(c.part_a, c.part_b);
    std::swap(c.material_a, c.material_b);
    std::swap(c.point_a, c.point_b);
    c.normal = -c.normal;
    c.friction_impulse = -c.friction_impulse, c.friction_force = -c.friction_force;
}

}  // namespace

void ContactRecord::take(const World& world, const Stepper& stepper) {
    take_contacts(world, stepper);
    take_particles(world, stepper);
    touched_before_.swap(touching_);
    take_events();
}

void ContactRecord::start_from(std::vector<Pair> touching) {
    contacts_.clear(), particle_contacts_.clear(), events_.clear();
    touching_ = std::move(touching);
}

void ContactRecord::take_contacts(const World& world, const Stepper& stepper) {
    contacts_.clear();
    if (!stepper.plan.runs(Effect::contacts)) return;
    for (std::size_t i = 0; i < world.contacts.found.size(); ++i)
        add_contact(world, world.contacts, i, stepper.sums->bodies()[i]);
    // what sleeps bears what it bore in the last substep before
    for (std::size_t i = 0; i < world.asleep.found.size(); ++i) {
        const ContactMemory& memory = world.asleep.memory[i];
        const double substeps = world.settings.substeps;
        add_contact(world, world.asleep, i,
                    {substeps * memory.normal_impulse, substeps * memory.friction_impulse, 0});
    }
    // slots and identifiers part once bodies were removed
    const auto before = [](const BodyContact& x, const BodyContact& y) {
        return pair_of(x) < pair_of(y);
    };
    if (!std::is_sorted(contacts_.begin(), contacts_.end(), before))
        std::sort(contacts_.begin(), contacts_.end(), before);
}

void ContactRecord::add_contact(const World& world, const RememberedContacts& table, std::size_t i,
                                const ContactSum& sum) {
    const Bodies& b = world.bodies;
    const std::vector<Pose>& then = world.contacts.kept.seen;
    const Contact& found = table.found[i];
    BodyContact& c = contacts_.emplace_back();
    c.body_a = b.id[found.a], c.body_b = b.id[found.b];
    c.part_a = found.part_a, c.part_b = found.part_b;
    c.material_a = b.material[found.a], c.material_b = b.material[found.b];
    c.normal = to_eigen(found.normal);
    c.point_a =
        ridden(b, found.a, then[found.a], to_eigen(found.point_a)) - found.radius_a * c.normal;
    c.point_b =
        ridden(b, found.b, then[found.b], to_eigen(found.point_b)) + found.radius_b * c.normal;
    c.gap = c.normal.dot(c.point_a - c.point_b);
    c.normal_impulse = sum.normal, c.friction_impulse = sum.friction;
    c.normal_force = sum.normal / world.settings.dt;
    c.friction_force = sum.friction / world.settings.dt;
    c.approach_speed = sum.approach;
    c.touches = table.memory[i].normal_impulse > 0 || c.gap <= 0;
    put_in_order(c);
}

void ContactRecord::take_particles(const World& world, const Stepper& stepper) {
    particle_contacts_.clear();
    if (!stepper.plan.runs(Effect::particle_contacts)) return;
    const Particles& p = world.particles;
    const ParticleContactTable& table = world.particle_contacts;
    for (std::size_t i = 0; i < table.found.size(); ++i) {
        const Contact& found = table.found[i];
        const ContactSum& sum = stepper.sums->particles()[i];
        ParticleContact& c = particle_contacts_.emplace_back();
        c.particle = found.a, c.body = world.bodies.id[found.b];
        c.deformable = p.deformable[found.a];
        c.material_a = p.material[found.a], c.material_b = world.bodies.material[found.b];
        c.normal = to_eigen(found.normal);
        c.point_a = p.position[found.a] - found.radius_a * c.normal;
        c.point_b = in_world(world.bodies, found.b, table.track[i]) + found.radius_b * c.normal;
        c.gap = c.normal.dot(c.point_a - c.point_b);
        c.normal_impulse = sum.normal, c.friction_impulse = sum.friction;
        c.normal_force = sum.normal / world.settings.dt;
        c.friction_force = sum.friction / world.settings.dt;
    }
}

void ContactRecord::tell_end(const Pair& pair) {
    events_.push_back({ContactEvent::Kind::ended, pair.first, pair.second, 0, 0, Vector3d::Zero()});
}

/// For all that may happen to the pairs at hand, so that a step in which much happens allocates no
/// more than others.
void ContactRecord::reserve_events() {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
        pairs += i == 0 || pair_of(contacts_[i]) != pair_of(contacts_[i - 1]);
    const auto make_room = [](auto& list, std::size_t most) {
        if (list.capacity() < most) list.reserve(2 * most);
    };
    make_room(touching_, pairs), make_room(touched_before_, pairs);
    make_room(events_, 3 * pairs + touched_before_.size());
}

/// One walk along the contacts and the pairs that touched before, both sorted.
void ContactRecord::take_events() {
    events_.clear(), touching_.clear();
    reserve_events();
    auto old = touched_before_.begin();
    for (auto first = contacts_.begin(); first != contacts_.end();) {
        const Pair pair = pair_of(*first);
        const auto last = std::find_if(first, contacts_.end(),
                                       [&](const BodyContact& c) { return pair_of(c) != pair; });
        for (; old != touched_before_.end() && *old < pair; ++old) tell_end(*old);
        const bool touched_before = old != touched_before_.end() && *old == pair;
        if (touched_before) ++old;

        ContactEvent event{ContactEvent::Kind::began, pair.first, pair.second, 0, 0, {}};
        bool touches = false;
        const BodyContact* hardest = &*first;
        for (; first != last; ++first) {
            event.impulse += first->normal_impulse;
            event.approach_speed = std::max(event.approach_speed, first->approach_speed);
            touches |= first->touches;
            if (first->normal_impulse > hardest->normal_impulse) hardest = &*first;
        }
        event.point = 0.5 * (hardest->point_a + hardest->point_b);
        const bool touched = touches || event.impulse > 0;
        const bool hit = event.impulse > 0 && (event.impulse >= watch_.least_impulse ||
                                               event.approach_speed >= watch_.least_speed);
        const auto tell = [&](ContactEvent::Kind kind) {
            event.kind = kind;
            events_.push_back(event);
        };
        if (touched && !touched_before) tell(ContactEvent::Kind::began);
        if (hit) tell(ContactEvent::Kind::hit);
        if (!touches && (touched || touched_before)) tell(ContactEvent::Kind::ended);
        if (touches) touching_.push_back(pair);
    }
    for (; old != touched_before_.end(); ++old) tell_end(*old);
}

}  // namespace plumb
