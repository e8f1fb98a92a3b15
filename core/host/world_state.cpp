// SPDX-License-Identifier: MIT
#include "host/world_state.h"

#include "contacts/contact_pairs.h"
#include "world/sleep.h"
#include "world/tears.h"

#include <algorithm>

namespace plumb {
namespace {

/// Calls io(x) for each number of the parts that follow; `io` may be a writer of what is const, or
/// a reader.
template <class Io, class V>
void vector(Io& io, V& v) {
    for (int k = 0; k < 3; ++k) io(v[k]);
}
template <class Io, class Q>
void quaternion(Io& io, Q& q) {
    for (int k = 0; k < 4; ++k) io(q.coeffs()[k]);
}
template <class Io, class V>
void plain_vector(Io& io, V& v) {
    io(v.x), io(v.y), io(v.z);
}

template <class Io, class B>
void each_number_of_bodies(Io& io, B& b) {
    for (std::size_t i = 0; i < b.size(); ++i) {
        quaternion(io, b.orientation[i]);
        for (auto* column : {&b.position, &b.velocity, &b.angular_velocity, &b.force, &b.torque,
                             &b.velocity_now, &b.angular_velocity_now, &b.velocity_before,
                             &b.angular_velocity_before, &b.angular_momentum, &b.turn_change})
            vector(io, (*column)[i]);
        io(b.lost_to_ground[i]), io(b.rest_time[i]), io(b.sleeps_with[i]);
        vector(io, b.rest_way[i]), vector(io, b.rest_turn[i]);
        auto& m = b.world_inverse_inertia[i];
        io(m.xx), io(m.yy), io(m.zz), io(m.xy), io(m.xz), io(m.yz);
    }
}

template <class Io, class Table>
void each_number_of_joints(Io& io, Table& table) {
    for (auto& joint : table.joints) {
        io(joint.broken), io(joint.keeps_apart);
        for (auto& x : joint.rows) io(x);
        for (auto& x : joint.rows_before) io(x);
        io(joint.pace.parts), io(joint.pace.before), io(joint.pace.calm);
        io(joint.island_rest.steps), io(joint.island_rest.misses), io(joint.owed);
    }
    for (auto& turn : table.turn) io(turn);
    for (auto& drive : table.drives) {
        io(drive.impulse), io(drive.impulse_before), io(drive.axis_impulse);
        auto& motor = drive.spec.motor;
        io(motor.target), io.count(motor.keys);
        for (auto& key : motor.keys) io(key.time), io(key.value);
    }
    for (auto& coupling : table.couplings) io(coupling.impulse), io(coupling.deferred);
}

template <class Io, class List>
void each_number_of_contacts(Io& io, List& contacts) {
    io.count(contacts);
    for (auto& c : contacts) {
        io(c.a), io(c.b), io(c.feature);
        plain_vector(io, c.point_a), plain_vector(io, c.point_b), plain_vector(io, c.normal);
        io(c.gap), io(c.radius_a), io(c.radius_b);
        io(c.flags), io(c.part_a), io(c.part_b), io(c.reserved);
    }
}

/// `table`: found and memory.
template <class Io, class Table>
void each_number_of_memory(Io& io, Table& table) {
    each_number_of_contacts(io, table.found);
    io.count(table.memory);
    for (auto& m : table.memory) {
        io(m.normal_impulse), io(m.gap), io(m.disputed_overlap);
        vector(io, m.friction_impulse), vector(io, m.rolling_impulse);
        vector(io, m.stick_a), vector(io, m.stick_b);
        io(m.sticks), io(m.exact), io(m.jammed), io(m.disputed), io(m.settling), io(m.missed),
            io(m.moved), io(m.flush), io(m.ghost), io(m.known), io(m.matched);
    }
}

/// `kept`: rides, pairs and poses.
template <class Io, class Kept>
void each_number_of_kept(Io& io, Kept& kept) {
    io.count(kept.rides);
    for (auto& r : kept.rides)
        plain_vector(io, r.point_a), plain_vector(io, r.point_b), plain_vector(io, r.normal);
    io.count(kept.pairs);
    for (auto& pair : kept.pairs) {
        io(pair.a), io(pair.b), io(pair.count), io(pair.fresh);
        io(pair.margin), io(pair.reach), io(pair.moved);
    }
    io.count(kept.poses);
    for (auto& pose : kept.poses) vector(io, pose.offset), quaternion(io, pose.turn);
}

template <class Io, class W>
void each_number_of_contacts_of(Io& io, W& world) {
    each_number_of_memory(io, world.contacts);
    io(world.contacts.rejected);
    io.count(world.contacts.kept.seen);
    for (auto& pose : world.contacts.kept.seen) {
        plain_vector(io, pose.position);
        io(pose.rotation.x), io(pose.rotation.y), io(pose.rotation.z), io(pose.rotation.w);
    }
    each_number_of_kept(io, world.contacts.kept);
    each_number_of_memory(io, world.asleep);
    each_number_of_kept(io, world.asleep);
}

template <class Io, class Factors>
void each_number_of_factors(Io& io, Factors& kept) {
    for (auto* places : {&kept.places, &kept.before}) {
        io.count(*places);
        for (auto& place : *places) vector(io, place);
    }
    io.count(kept.near);
    for (auto& [a, b] : kept.near) io(a), io(b);
    const auto matrix = [&](auto& m) {
        for (int k = 0; k < 9; ++k) io(m.data()[k]);
    };
    io.count(kept.bodies);
    for (auto& body : kept.bodies) io(body.index), io(body.mass), matrix(body.inertia);
    io.count(kept.contacts);
    for (auto& c : kept.contacts) {
        io(c.points), matrix(c.stiffness);
        for (auto& particle : c.particle) io(particle);
        for (auto& weight : c.weight) io(weight);
        for (auto& body : c.body) io(body);
        for (auto& arm : c.arm) vector(io, arm);
    }
    io.count(kept.points);
    for (auto& particle : kept.points) io(particle);
    io.count(kept.rows);
    for (auto& row : kept.rows) {
        io(row.count), io(row.stiffness);
        for (auto& body : row.body) io(body);
        for (auto& on : row.on)
            for (int k = 0; k < 6; ++k) io(on[k]);
    }
}

template <class Io, class W>
void each_number_of_particles(Io& io, W& world) {
    for (std::size_t i = 0; i < world.particles.size(); ++i)
        vector(io, world.particles.position[i]), vector(io, world.particles.velocity[i]);
    for (auto& link : world.links) {
        vector(io, link.impulse);
        io(link.island_rest.steps), io(link.island_rest.misses);
    }
    for (auto& d : world.deformables) each_number_of_list(io, d.torn);
    io.count(world.surface_contacts);
    for (auto& c : world.surface_contacts) {
        io(c.point.particle), io(c.point.body), vector(io, c.point.position);
        for (auto& corner : c.triangle) io(corner);
        for (auto& weight : c.weights) io(weight);
        vector(io, c.normal), io(c.distance), io(c.friction), io(c.side);
    }
    io.count(world.elastic_impulses);
    for (auto& kept : world.elastic_impulses) {
        for (auto& particle : kept.particles) io(particle);
        io(kept.body), io(kept.part), io(kept.feature), io(kept.order), vector(io, kept.impulse);
    }
    each_number_of_factors(io, world.kept_factors);
}

template <class Io, class W>
void each_number(Io& io, W& world) {
    io(world.time), io(world.steps);
    each_number_of_bodies(io, world.bodies);
    each_number_of_joints(io, world.joints);
    each_number_of_contacts_of(io, world);
    each_number_of_particles(io, world);
}

/// Whether pairs of known bodies, in their order, have all contacts between them.
bool have_all_contacts(const std::vector<KeptPair>& pairs, const std::vector<Contact>& found,
                       std::size_t bodies) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const KeptPair& pair = pairs[i];
        if (!(pair.a < pair.b && pair.b < bodies)) return false;
        if (i > 0 && !(bodies_of(pairs[i - 1]) < bodies_of(pair))) return false;
        if (pair.count > found.size() - next) return false;
        for (const std::size_t end = next + pair.count; next < end; ++next)
            if (bodies_of(found[next]) != bodies_of(pair)) return false;
    }
    return next == found.size();
}

/// Columns of one length, and pairs that fit their contacts; else nothing is kept. `kept`: rides,
/// pairs and poses.
template <class Kept>
void drop_what_does_not_fit(RememberedContacts& table, Kept& kept, std::size_t bodies) {
    table.memory.resize(table.found.size());
    if (kept.rides.size() == table.found.size() && kept.pairs.size() == kept.poses.size() &&
        have_all_contacts(kept.pairs, table.found, bodies))
        return;
    kept.pairs.clear(), kept.poses.clear(), kept.rides.clear();
}

bool are_of_bodies(const std::vector<Contact>& contacts, std::size_t bodies) {
    return std::all_of(contacts.begin(), contacts.end(),
                       [&](const Contact& c) { return c.a < bodies && c.b < bodies; });
}

/// Who sleeps is told by with whom.
void send_to_sleep(Bodies& b) {
    for (std::uint32_t i = 0; i < b.size(); ++i) {
        if (!is_movable(b.motion[i]) || b.sleeps_with[i] >= b.size()) b.sleeps_with[i] = kNoIndex;
        if (is_movable(b.motion[i])) set_asleep(b, i, b.sleeps_with[i] != kNoIndex);
    }
}

/// Whether it is between a triangle of one deformable and something else that exists.
bool can_be(const SurfaceContact& c, const World& world) {
    const bool has_point = c.point.particle != kNoIndex ? c.point.particle < world.particles.size()
                                                        : c.point.body < world.bodies.size();
    const auto has_all = [&](const Deformable& d) {
        return std::all_of(c.triangle.begin(), c.triangle.end(), [&](std::uint32_t corner) {
            return corner >= d.first && corner - d.first < d.count;
        });
    };
    return has_point && std::any_of(world.deformables.begin(), world.deformables.end(), has_all);
}

/// Whether all that they were made of exists.
bool can_be(const KeptFactors& kept, const World& world) {
    const auto has_body = [&](std::uint32_t body) {
        return body == kNoIndex || body < kept.bodies.size();
    };
    const auto has_points = [&](const KeptFactors::Contact& c) {
        return c.points <= c.particle.size() &&
               std::all_of(
                   c.particle.begin(), c.particle.begin() + c.points,
                   [&](std::uint32_t particle) { return particle < world.particles.size(); }) &&
               std::all_of(c.body.begin(), c.body.end(), has_body);
    };
    const std::size_t tied = kept.bodies.size() + kept.points.size();
    const auto has_bodies = [&](const KeptFactors::Row& row) {
        return row.count <= row.body.size() &&
               std::all_of(row.body.begin(), row.body.begin() + row.count,
                           [&](std::uint32_t body) { return body < tied; });
    };
    const std::size_t n = world.particles.size();
    return std::all_of(kept.near.begin(), kept.near.end(),
                       [&](const auto& pair) { return pair.first < n && pair.second < n; }) &&
           std::all_of(kept.points.begin(), kept.points.end(),
                       [&](std::uint32_t i) { return i < n; }) &&
           std::all_of(kept.contacts.begin(), kept.contacts.end(), has_points) &&
           std::all_of(kept.rows.begin(), kept.rows.end(), has_bodies);
}

}  // namespace

void write_state(const World& world, StateWriter& to) { each_number(to, world); }

void read_state(World& world, StateReader& from) {
    each_number(from, world);
    send_to_sleep(world.bodies);
    const std::size_t bodies = world.bodies.size();
    drop_what_does_not_fit(world.contacts, world.contacts.kept, bodies);
    drop_what_does_not_fit(world.asleep, world.asleep, bodies);
    if (!are_of_bodies(world.asleep.found, bodies)) world.asleep = {};
    world.contacts.list_pairs();
    std::erase_if(world.surface_contacts,
                  [&](const SurfaceContact& c) { return !can_be(c, world); });
    std::erase_if(world.elastic_impulses,
                  [](const ElasticImpulse& kept) { return !kept.impulse.allFinite(); });
    std::sort(world.elastic_impulses.begin(), world.elastic_impulses.end());
    if (!can_be(world.kept_factors, world)) world.kept_factors = {};
    for (Deformable& d : world.deformables)
        if (d.can_tear()) leave_out_torn(d);
}

}  // namespace plumb
