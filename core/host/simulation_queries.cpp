// SPDX-License-Identifier: MIT
/// Questions to the collider, at the poses of now.
#include "contacts/contact_room.h"
#include "host/guest.h"
#include "host/simulation_parts.h"
#include "scene/error.h"

#include <algorithm>
#include <stdexcept>

namespace plumb {
namespace {

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
    expect_answer(place_all(proximity, poses_of(world.bodies), {nullptr, want_none}, 0, room),
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

std::vector<std::uint32_t> Simulation::overlaps(std::uint32_t geometry, const Placement& placement,
                                                std::uint32_t mask) {
    expect_placement(placement);
    Parts::Guest guest(*parts_, geometry, mask);
    std::vector<std::uint32_t> found;
    for (const Contact& c : guest.contacts_at(placement, 0))
        if (c.gap <= 0) found.push_back(parts_->world.bodies.id[c.a]);
    guest.leave();
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace plumb
