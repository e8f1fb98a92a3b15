// SPDX-License-Identifier: MIT
#include "host/add_bodies.h"

#include "scene/error.h"

#include <cstdint>

namespace plumb {
namespace {

void check(const Status& status, const std::string& collider, const std::string& about) {
    if (status.code == Status::ok) return;
    throw ColliderError("collider \"" + collider + "\" refused the " + about + ": " +
                        (status.message ? status.message : "it gave no reason"));
}

void add_shapes(Proximity& proximity, const World& world, const Scene& scene,
                const std::string& collider) {
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
        const BodySpec& spec = scene.bodies[i];
        if (spec.geometry == kNoIndex) continue;
        ShapePlacement placement{};
        placement.shape = world.shapes[spec.geometry];
        const Placement& local = world.bodies.geometry_in_body[i];
        placement.local = {to_plain(local.position), to_plain(local.rotation)};
        placement.mobility = static_cast<Mobility>(spec.motion);
        placement.group = spec.group;
        placement.mask = spec.mask;
        check(proximity.add(i, placement), collider, "shape of body " + std::to_string(i));
    }
}

void exclude_pairs(Proximity& proximity, const World& world, const Scene& scene,
                   const std::string& collider) {
    for (const std::uint64_t key : world.excluded) {
        const auto a = static_cast<std::uint32_t>(key >> 32), b = static_cast<std::uint32_t>(key);
        if (scene.bodies[a].geometry == kNoIndex || scene.bodies[b].geometry == kNoIndex) continue;
        check(proximity.exclude(a, b, true), collider, "pair of bodies kept apart");
    }
}

}  // namespace

void add_bodies(Proximity& proximity, const World& world, const Scene& scene,
                const std::string& collider) {
    add_shapes(proximity, world, scene, collider);
    exclude_pairs(proximity, world, scene, collider);
}

}  // namespace plumb
