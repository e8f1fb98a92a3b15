// SPDX-License-Identifier: MIT
/// Questions to the collider, at the poses of now.
#include "contacts/contact_room.h"
#include "host/simulation_parts.h"
#include "scene/error.h"

#include <algorithm>
#include <stdexcept>

namespace plumb {
namespace {

std::vector<Pose> poses_of(const Bodies& b) {
    std::vector<Pose> poses;
    poses.reserve(b.size() + 1);
    for (std::size_t i = 0; i < b.size(); ++i)
        poses.push_back({to_plain(b.position[i]), to_plain(b.orientation[i])});
    return poses;
}

/// Tells the collider where bodies are, and asks for the contacts of pairs that are let through.
Status place_all(Proximity& proximity, const std::vector<Pose>& poses, const PairFilter& filter,
                 ContactRoom& room) {
    const ContactSink sink = room.sink();
    return proximity.detect(
        {poses.data(), nullptr, static_cast<std::uint32_t>(poses.size()), 0, 0, &filter}, &sink, 1);
}

/// The same contact with its bodies in the other order.
Contact swapped(Contact c) {
    std::swap(c.a, c.b);
    std::swap(c.point_a, c.point_b);
    std::swap(c.radius_a, c.radius_b);
    std::swap(c.part_a, c.part_b);
    c.normal = {-c.normal.x, -c.normal.y, -c.normal.z};
    return c;
}

}  // namespace

Proximity& Simulation::Parts::at_poses_of_now() {
    renew();
    if (!stepper.plan.runs(Effect::contacts))
        throw std::logic_error("the scene has no contacts, so the collider has no bodies");
    if (placed) return proximity;
    const auto want_none = [](void*, const CandidatePair*, std::uint32_t count,
                              std::uint8_t* wanted) { std::fill_n(wanted, count, 0); };
    ContactRoom room;
    expect_answer(place_all(proximity, poses_of(world.bodies), {nullptr, want_none}, room),
                  "place to the bodies");
    placed = true;
    return proximity;
}

void Simulation::Parts::expect_answer(const Status& status, const std::string& question) const {
    if (status.code == Status::ok) return;
    const std::string sentence = "collider \"" + collider_name + "\" gave no " + question + ": " +
                                 (status.message ? status.message : "it gave no reason");
    if (status.code == Status::bad_argument) throw std::invalid_argument(sentence);
    throw ColliderError(sentence);
}

std::optional<RayHit> Simulation::cast_ray(const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction, double length,
                                           std::uint32_t mask) {
    const RayRequest ray{to_plain(origin), to_plain(direction), length, mask, 0};
    RayHit hit{kNoBody, 0, 0, {0, 0, 0}};
    parts_->expect_answer(parts_->at_poses_of_now().cast_rays(&ray, &hit, 1), "hit of a ray");
    if (hit.body == kNoBody) return std::nullopt;
    const std::vector<std::uint32_t>& ids = parts_->world.bodies.id;
    if (hit.body >= ids.size())
        throw ColliderError("collider \"" + parts_->collider_name +
                            "\" says that a ray hits a body that there is not");
    hit.body = ids[hit.body];
    return hit;
}

Contact Simulation::closest(std::uint32_t body_a, std::uint32_t body_b) {
    const std::uint32_t a = parts_->slot(body_a), b = parts_->slot(body_b);
    Contact contact{};
    parts_->expect_answer(parts_->at_poses_of_now().closest(a, b, &contact), "closest points");
    contact.a = a < b ? body_a : body_b, contact.b = a < b ? body_b : body_a;
    return contact.a < contact.b ? contact : swapped(contact);
}

/// The shape is a guest of the collider, behind the last body, for this one question.
std::vector<std::uint32_t> Simulation::overlaps(std::uint32_t geometry, const Placement& placement,
                                                std::uint32_t mask) {
    Parts& p = *parts_;
    const Bodies& bodies = p.world.bodies;
    if (geometry >= p.assets.geometries.size())
        throw std::out_of_range("there is no geometry " + std::to_string(geometry));
    expect_placement(placement);
    Proximity& proximity = p.at_poses_of_now();
    auto guest = static_cast<std::uint32_t>(bodies.size());
    BodyRow row;
    row.id = p.world.slots.next().id;
    row.motion = Motion::dynamic, row.geometry = geometry;
    row.group = ~0u, row.mask = mask;
    p.check_pairs(row, "asked about");
    plumb::add_body(proximity, p.world, guest, row, p.collider_name);

    std::vector<Pose> poses = poses_of(bodies);
    poses.push_back({to_plain(placement.position), to_plain(placement.rotation.normalized())});
    const auto of_guest = [](void* ctx, const CandidatePair* pairs, std::uint32_t count,
                             std::uint8_t* wanted) {
        for (std::uint32_t i = 0; i < count; ++i)
            wanted[i] = pairs[i].b == *static_cast<std::uint32_t*>(ctx);
    };
    ContactRoom room;
    p.placed = false;
    const Status status = place_all(proximity, poses, {&guest, of_guest}, room);
    const Status removed = proximity.remove(guest);
    p.expect_answer(status, "overlaps");
    p.expect_answer(removed, "way to take the shape away that was asked about");

    std::vector<std::uint32_t> found;
    for (const Contact& c : room)
        if (c.b == guest && c.a < guest && c.gap <= 0) found.push_back(bodies.id[c.a]);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace plumb
