// SPDX-License-Identifier: MIT
/// What the ties of an exact island have in common when they make rows.
#pragma once

#include "constraints/connector.h"
#include "schedule/contact_islands.h"
#include "step/island.h"
#include "world/world.h"

namespace plumb {

/// Index of a body among those of its island, or kImmovable.
inline std::uint32_t index_in_island(const World& world, const ContactIslands& islands,
                                     std::uint32_t body) {
    if (body == kNoIndex || world.bodies.motion[body] != Motion::dynamic) return kImmovable;
    return islands.index_in_island(world.bodies.row[body]);
}

/// How a body of the world moves that is immovable to the island.
inline Velocity<double> scripted_velocity(const Bodies& b, std::uint32_t body) {
    if (body == kNoIndex) return {Vector3d::Zero(), Vector3d::Zero()};
    return {b.velocity[body], b.angular_velocity[body]};
}

/// The velocity of a body of the island, or else that with which it moves by itself.
inline Velocity<double> velocity_of(std::uint32_t body, const Velocity<double>& scripted,
                                    std::span<const Vector6d> velocity) {
    if (body == kImmovable) return scripted;
    return {velocity[body].head<3>(), velocity[body].tail<3>()};
}

}  // namespace plumb
