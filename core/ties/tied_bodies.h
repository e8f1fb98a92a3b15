// SPDX-License-Identifier: MIT
/// What ties have in common when they make rows.
#pragma once

#include "constraints/connector.h"
#include "ties/tie_row.h"
#include "world/world.h"

#include <array>
#include <span>

namespace plumb {

/// Of a tie, in the order of `each_body` (world/tie.h).
using TiedBodies = std::array<std::uint32_t, TieRow::kMostSides>;

/// How a body of the world moves that is immovable to the system.
inline Velocity<double> scripted_velocity(const Bodies& b, std::uint32_t body) {
    if (body == kNoIndex) return {Vector3d::Zero(), Vector3d::Zero()};
    return {b.velocity[body], b.angular_velocity[body]};
}

/// The velocity of a body of the system, or else that with which it moves by itself.
inline Velocity<double> velocity_of(std::uint32_t body, const Velocity<double>& scripted,
                                    std::span<const Vector6d> velocity) {
    if (body == kImmovable) return scripted;
    return {velocity[body].head<3>(), velocity[body].tail<3>()};
}

}  // namespace plumb
