// SPDX-License-Identifier: MIT
#include "world/edit_world.h"

#include <algorithm>

namespace plumb {
namespace {

void count(World& world, Motion motion, std::int32_t change) {
    if (motion == Motion::dynamic) world.dynamic_count += change;
    if (motion == Motion::kinematic) world.kinematic_count += change;
}

/// `kept`: pairs and poses.
template <class Kept, class Is>
void forget_pairs(Kept& kept, Is is_of_body) {
    std::size_t stays = 0;
    for (std::size_t i = 0; i < kept.pairs.size(); ++i) {
        if (is_of_body(kept.pairs[i])) continue;
        kept.pairs[stays] = kept.pairs[i];
        kept.poses[stays++] = kept.poses[i];
    }
    kept.pairs.resize(stays), kept.poses.resize(stays);
}

template <class Is>
void forget_contacts(RememberedContacts& c, std::vector<ContactRide>& rides, Is is_of_body) {
    const bool has_rides = !rides.empty();
    std::size_t stays = 0;
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        if (is_of_body(c.found[i])) continue;
        c.found[stays] = c.found[i];
        c.memory[stays] = c.memory[i];
        if (has_rides) rides[stays] = rides[i];
        ++stays;
    }
    c.found.resize(stays), c.memory.resize(stays);
    if (has_rides) rides.resize(stays);
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
    forget_contacts(c, c.kept.rides, is_of_body);
    forget_contacts(world.asleep, world.asleep.rides, is_of_body);
    c.list_pairs();
    forget_pairs(c.kept, is_of_body);
    forget_pairs(world.asleep, is_of_body);
    world.particle_contacts = {};
    std::erase_if(world.surface_contacts,
                  [slot](const SurfaceContact& x) { return x.point.body == slot; });
    std::erase_if(world.elastic_impulses,
                  [slot](const ElasticImpulse& x) { return x.body == slot; });
    for (const KeptFactors::Body& body : world.kept_factors.bodies)
        if (body.index == slot) return world.kept_factors.clear();
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
