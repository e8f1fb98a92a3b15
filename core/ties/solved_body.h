// SPDX-License-Identifier: MIT
/// The bodies of a system that is solved as a whole: of an island, or of what touches a sheet.
#pragma once

#include "math/symmetric.h"
#include "math/types.h"

#include <cstdint>
#include <span>

namespace plumb {

/// In place of the index of a body of the system.
inline constexpr std::uint32_t kImmovable = ~0u;

struct SolvedBody {
    std::uint32_t body;  ///< in the world's tables
    double mass;
    Symmetric3<double> inertia, inverse_inertia;  ///< world frame
};

/// M⁻¹ times (force, torque).
inline Vector6d response(const SolvedBody& body, const Vector6d& sum) {
    Vector6d v;
    v << sum.head<3>() / body.mass, body.inverse_inertia * Vector3d(sum.tail<3>());
    return v;
}
/// M times (v, ω).
inline Vector6d momentum(const SolvedBody& body, const Vector6d& v) {
    Vector6d p;
    p << body.mass * v.head<3>(), body.inertia * Vector3d(v.tail<3>());
    return p;
}

/// Of bodies that move by `v` [J].
inline double kinetic_energy(std::span<const SolvedBody> bodies, std::span<const Vector6d> v) {
    double twice = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) twice += v[i].dot(momentum(bodies[i], v[i]));
    return 0.5 * twice;
}

}  // namespace plumb
