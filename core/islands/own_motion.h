// SPDX-License-Identifier: MIT
/// What is immovable to an island may move by itself: how a contact's point moves by that.
#pragma once

#include "constraints/connector.h"
#include "islands/island.h"
#include "world/world.h"

#include <vector>

namespace plumb {

struct OwnMotion {
    Vector3d moving = Vector3d::Zero();   ///< velocity of a against b [m/s]
    Vector3d turning = Vector3d::Zero();  ///< [rad/s]

    /// velocity, angular_velocity: [body].
    OwnMotion(const World& world, const IslandPoint& p, std::uint32_t contact,
              const std::vector<Vector3d>& velocity,
              const std::vector<Vector3d>& angular_velocity) {
        const auto add = [&](std::uint32_t body, const Vector3d& arm, double sign) {
            const Velocity<double> of{velocity[body], angular_velocity[body]};
            moving += sign * velocity_at(of, arm);
            turning += sign * of.w;
        };
        const Contact& c = world.contacts.found[contact];
        if (p.a == kImmovable) add(c.a, p.arm_a, 1);
        if (p.b == kImmovable) add(c.b, p.arm_b, -1);
    }

    bool is_none() const { return moving.isZero(0) && turning.isZero(0); }

    /// What it does to the island by the impulses of a point [J].
    double work(const IslandPoint& p) const {
        double work = -(p.frame.transpose() * moving).dot(p.impulse.head<3>());
        if (p.cone.turns())
            work -= p.length * (p.frame.transpose() * turning).dot(p.impulse.tail<3>());
        return work;
    }

    /// Leaves of what is wanted at a point the part of the island's bodies.
    void take_from(IslandPoint& p) const {
        p.wanted.head<3>() -= p.frame.transpose() * moving;
        if (p.cone.turns()) p.wanted.tail<3>() -= p.length * (p.frame.transpose() * turning);
    }
};

}  // namespace plumb
