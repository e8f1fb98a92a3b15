// SPDX-License-Identifier: MIT
#include "host/guest.h"

#include "geometry/mass_properties.h"

#include <stdexcept>
#include <string>

namespace plumb {

std::vector<Pose> poses_of(const Bodies& b) {
    std::vector<Pose> poses;
    poses.reserve(b.size() + 1);
    for (std::size_t i = 0; i < b.size(); ++i)
        poses.push_back({to_plain(b.position[i]), to_plain(b.orientation[i])});
    return poses;
}

Status place_all(Proximity& proximity, const std::vector<Pose>& poses, const PairFilter& filter,
                 double margin, ContactRoom& room) {
    const ContactSink sink = room.sink();
    return proximity.detect(
        {poses.data(), nullptr, static_cast<std::uint32_t>(poses.size()), 0, margin, &filter},
        &sink, 1);
}

Simulation::Parts::Guest::Guest(Parts& parts, std::uint32_t geometry, std::uint32_t mask)
    : parts_(parts), geometry_(geometry) {
    if (geometry >= parts.assets.geometries.size())
        throw std::out_of_range("there is no geometry " + std::to_string(geometry));
    Proximity& proximity = parts.at_poses_of_now();
    const World& world = parts.world;
    slot_ = static_cast<std::uint32_t>(world.bodies.size());
    BodyRow row;
    row.id = world.slots.next().id;
    row.motion = Motion::dynamic, row.geometry = geometry;
    row.group = ~0u, row.mask = mask;
    parts.check_pairs(row, "asked about");
    plumb::add_body(proximity, world, slot_, row, parts.collider_name);
    poses_ = poses_of(world.bodies);
    poses_.emplace_back();
}

Simulation::Parts::Guest::~Guest() {
    if (is_here_) (void)parts_.proximity.remove(slot_);
}

const std::vector<Contact>& Simulation::Parts::Guest::contacts_at(const Placement& placement,
                                                                  double margin) {
    poses_.back() = {to_plain(placement.position), to_plain(placement.rotation.normalized())};
    const auto of_guest = [](void* ctx, const CandidatePair* pairs, std::uint32_t count,
                             std::uint8_t* wanted) {
        for (std::uint32_t i = 0; i < count; ++i)
            wanted[i] = pairs[i].b == *static_cast<std::uint32_t*>(ctx);
    };
    parts_.placed = false;
    room_.clear();
    parts_.expect_answer(place_all(parts_.proximity, poses_, {&slot_, of_guest}, margin, room_),
                         "contacts of a shape that was asked about");
    contacts_.clear();
    for (const Contact& c : room_)
        if (c.b == slot_ && c.a < slot_) contacts_.push_back(c);
    return contacts_;
}

double Simulation::Parts::Guest::bounding_radius() const {
    return plumb::bounding_radius(parts_.assets.geometries[geometry_], Vector3d::Zero());
}

void Simulation::Parts::Guest::leave() {
    is_here_ = false;
    parts_.placed = false;
    parts_.expect_answer(parts_.proximity.remove(slot_),
                         "way to take the shape away that was asked about");
}

}  // namespace plumb
