// SPDX-License-Identifier: MIT
/// How bodies that joints hold together move as one piece: with what they hang by, or with the
/// momentum that they have. Velocities against that may be lost without a change of that momentum.
#pragma once

#include "step/free_turn.h"

namespace plumb {

struct RestMotion {
    Vector3d point = Vector3d::Zero();      ///< [m]
    Velocity<double> motion{point, point};  ///< there [m/s], [rad/s]

    Velocity<double> of(const Bodies& b, std::uint32_t body) const {
        return {velocity_at<double>(motion, b.position[body] - point), motion.w};
    }
};

/// With the momentum that they have. `each(visit)` calls visit(body, velocity) for all of them.
template <class Each>
RestMotion motion_as_one(const Bodies& b, Each each) {
    double mass = 0;
    Vector3d momentum = Vector3d::Zero();
    each([&](std::uint32_t i, const Velocity<double>& x) {
        mass += b.mass[i], momentum += b.mass[i] * x.v;
    });
    const FreeBodies all(b, each);
    return {all.centre, {momentum / mass, -all.turn_against(all.momentum).rate}};
}

}  // namespace plumb
