// SPDX-License-Identifier: MIT
#include "world/edit_world.h"

#include <algorithm>

namespace plumb {
namespace {

void count(World& world, Motion motion, std::int32_t change) {
    if (motion == Motion::dynamic) world.dynamic_count += change;
    if (motion == Motion::kinematic) world.kinematic_count += change;
}

/// Rows of a table that stand side by side, from the first to before the last.
struct Rows {
    std::size_t first, last;
};

/// Those that are of a body.
template <class Row, class Is>
std::vector<Rows> rows_of(const std::vector<Row>& table, Is is_of_body) {
    std::vector<Rows> rows;
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (!is_of_body(table[i])) continue;
        if (rows.empty() || rows.back().last < i) rows.push_back({i, i});
        ++rows.back().last;
    }
    return rows;
}

/// Takes rows out of a column, unless it is empty altogether.
template <class Row>
void take_out(const std::vector<Rows>& rows, std::vector<Row>& column) {
    if (rows.empty() || column.empty()) return;
    const auto at = [&](std::size_t i) { return column.begin() + static_cast<std::ptrdiff_t>(i); };
    auto to = at(rows[0].first);
    for (std::size_t k = 0; k < rows.size(); ++k)
        to = std::move(at(rows[k].last), k + 1 < rows.size() ? at(rows[k + 1].first) : column.end(),
                       to);
    column.erase(to, column.end());
}
template <class... Columns>
void take_out(const std::vector<Rows>& rows, Columns&... columns) {
    (take_out(rows, columns), ...);
}

/// Takes pairs out of their list, with their contacts.
void take_out_pairs(const std::vector<Rows>& rows, ContactTable& c) {
    if (rows.empty()) return;
    std::vector<Rows> contacts;
    for (const Rows& r : rows) {
        const ContactPair &first = c.pairs[r.first], &last = c.pairs[r.last - 1];
        contacts.push_back({first.first, last.first + last.count});
    }
    take_out(contacts, c.found, c.memory, c.kept.rides);
    take_out(rows, c.pairs);
    for (std::size_t p = rows[0].first; p < c.pairs.size(); ++p)
        c.pairs[p].first = p > 0 ? c.pairs[p - 1].first + c.pairs[p - 1].count : 0;
}

}  // namespace

std::uint32_t insert_body(World& world, BodyRow row) {
    const std::uint32_t slot = world.slots.next().slot;
    if (slot == world.bodies.size()) resize_bodies(world.bodies, slot + 1);
    row.id = world.slots.add().id;
    put_body(world.bodies, slot, row);
    count(world, row.motion, 1);
    return row.id;
}

void erase_body(World& world, std::uint32_t slot) {
    forget_contacts(world, slot);
    std::erase_if(world.excluded, [slot](std::uint64_t key) {
        return key >> 32 == slot || std::uint32_t(key) == slot;
    });
    std::erase_if(world.links,
                  [slot](const Link& link) { return link.a.body == slot || link.b.body == slot; });
    count(world, world.bodies.motion[slot], -1);
    world.slots.remove(world.bodies.id[slot]);
    put_body(world.bodies, slot, BodyRow{});
    resize_bodies(world.bodies, world.slots.size());
}

void forget_contacts(World& world, std::uint32_t slot) {
    ContactTable& c = world.contacts;
    const auto is_of_body = [slot](const auto& x) { return x.a == slot || x.b == slot; };
    SleepingContacts& asleep = world.asleep;
    take_out_pairs(rows_of(c.pairs, is_of_body), c);
    take_out(rows_of(c.kept.pairs, is_of_body), c.kept.pairs, c.kept.poses);
    take_out(rows_of(asleep.found, is_of_body), asleep.found, asleep.memory, asleep.rides);
    take_out(rows_of(asleep.pairs, is_of_body), asleep.pairs, asleep.poses);
    world.particle_contacts = {};
    std::erase_if(world.surface_contacts,
                  [slot](const SurfaceContact& x) { return x.point.body == slot; });
    std::erase_if(world.elastic_impulses,
                  [slot](const ElasticImpulse& x) { return x.body == slot; });
    for (const KeptFactors::Body& body : world.kept_factors.bodies)
        if (body.index == slot) return world.kept_factors.drop();
}

std::uint32_t insert_joint(World& world, JointDraft draft) {
    append_joint(world, std::move(draft));
    count_springs(world);
    const Joint& joint = world.joints.joints.back();
    if (joint.keeps_apart)
        std::inplace_merge(world.excluded.begin(), world.excluded.end() - 1, world.excluded.end());
    return joint.id;
}

void stop_keeping_apart(World& world, Joint& joint) {
    if (joint.keeps_apart)
        world.excluded.erase(
            std::lower_bound(world.excluded.begin(), world.excluded.end(), kept_apart(joint)));
    joint.keeps_apart = false;
}

void erase_joint(World& world, std::uint32_t index) {
    JointTable& table = world.joints;
    stop_keeping_apart(world, table.joints[index]);
    std::erase_if(table.couplings, [index](const JointCoupling& c) {
        return c.joint_a == index || c.joint_b == index;
    });
    std::erase_if(table.drives, [index](const JointDrive& d) { return d.joint == index; });
    table.joints.erase(table.joints.begin() + index);
    table.turn.erase(table.turn.begin() + index);
    for (JointDrive& d : table.drives) d.joint -= d.joint > index;
    for (JointCoupling& c : table.couplings)
        c.joint_a -= c.joint_a > index, c.joint_b -= c.joint_b > index;
    count_springs(world);
}

void erase_coupling(World& world, std::uint32_t index) {
    world.joints.couplings.erase(world.joints.couplings.begin() + index);
}

}  // namespace plumb
