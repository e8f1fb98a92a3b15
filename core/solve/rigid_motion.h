// SPDX-License-Identifier: MIT
#pragma once

#include "constraints/connector.h"
#include "world/bodies.h"

#include <cstdint>

namespace plumb {

/// Bodies that move as one piece.
struct RigidMotion {
    Vector3d point = Vector3d::Zero();      ///< [m]
    Velocity<double> motion{point, point};  ///< there [m/s], [rad/s]

    bool is_rest() const { return motion.v.isZero(0) && motion.w.isZero(0); }

    /// The velocities of one of them.
    Velocity<double> of(const Bodies& b, std::uint32_t body) const {
        return {velocity_at<double>(motion, b.position[body] - point), motion.w};
    }
};

}  // namespace plumb
