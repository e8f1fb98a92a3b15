// SPDX-License-Identifier: MIT
#include "host/add_bodies.h"

#include "contacts/contact_room.h"
#include "scene/error.h"
#include "world/sleep.h"

#include <cstdint>
#include <vector>

namespace plumb {
namespace {

void check(const Status& status, const std::string& collider, const std::string& about) {
    if (status.code == Status::ok) return;
    throw ColliderError("collider \"" + collider + "\" refused the " + about + ": " +
                        (status.message ? status.message : "it gave no reason"));
}

std::string name_of(std::uint32_t id) { return "body " + std::to_string(id); }

/// Asks once, at the poses of now, for what the back-end itself says.
void check_raw(Proximity& proximity, const World& world, const std::string& collider) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        poses.push_back(
            {to_plain(world.bodies.position[i]), to_plain(world.bodies.orientation[i])});
    ContactRoom room;
    const ContactSink sink = room.sink();
    const Status status =
        proximity.detect({poses.data(), nullptr, static_cast<std::uint32_t>(poses.size()),
                          kDetectRaw, world.settings.margin},
                         &sink, 1);
    if (status.code != Status::unsupported) return;  // other trouble is that of steps
    throw ColliderError("collider \"" + collider +
                        "\" does not tell what its back-end itself reports, which \"contacts\": "
                        "\"raw\" asks for: " +
                        (status.message ? status.message : "it gave no reason"));
}

}  // namespace

BodyRow shape_row(const Bodies& b, std::uint32_t slot) {
    BodyRow row;
    row.id = b.id[slot], row.motion = awake(b.motion[slot]);
    row.geometry = b.geometry[slot], row.geometry_in_body = b.geometry_in_body[slot];
    row.group = b.group[slot], row.mask = b.mask[slot];
    return row;
}

void add_bodies(Proximity& proximity, const World& world, const std::string& collider) {
    std::uint32_t added = 0;
    try {
        for (; added < world.bodies.size(); ++added)
            add_body(proximity, world, added, shape_row(world.bodies, added), collider);
        for (const std::uint64_t key : world.excluded)
            exclude_pair(proximity, world, key, true, collider);
        if (world.settings.contacts == ContactOrigin::raw) check_raw(proximity, world, collider);
    } catch (...) {
        while (added-- > 0)
            if (world.bodies.geometry[added] != kNoIndex) proximity.remove(added);
        throw;
    }
}

void add_body(Proximity& proximity, const World& world, std::uint32_t slot, const BodyRow& row,
              const std::string& collider) {
    if (row.geometry == kNoIndex) return;
    ShapePlacement placement{};
    placement.shape = world.shapes[row.geometry];
    const Placement& local = row.geometry_in_body;
    placement.local = {to_plain(local.position), to_plain(local.rotation)};
    placement.mobility = static_cast<Mobility>(row.motion);
    placement.group = row.group;
    placement.mask = row.mask;
    check(proximity.add(slot, placement), collider, "shape of " + name_of(row.id));
}

void remove_body(Proximity& proximity, const World& world, std::uint32_t slot,
                 const std::string& collider) {
    if (world.bodies.geometry[slot] == kNoIndex) return;
    check(proximity.remove(slot), collider, "removal of " + name_of(world.bodies.id[slot]));
}

void exclude_pair(Proximity& proximity, const World& world, std::uint64_t key, bool excluded,
                  const std::string& collider) {
    const auto a = static_cast<std::uint32_t>(key >> 32), b = static_cast<std::uint32_t>(key);
    const Bodies& bodies = world.bodies;
    if (bodies.geometry[a] == kNoIndex || bodies.geometry[b] == kNoIndex) return;
    check(proximity.exclude(a, b, excluded), collider,
          excluded ? "pair of bodies kept apart" : "pair of bodies that may touch again");
}

}  // namespace plumb
