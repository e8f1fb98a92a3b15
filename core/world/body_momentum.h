// SPDX-License-Identifier: MIT
/// Angular momentum and energy of single bodies. The principal moments I are those of the body's
/// frame; ω and L are the world's.
#pragma once

#include "math/free_rotation.h"
#include "world/bodies.h"

namespace plumb {

/// L = q I q* ω, of body i rotating at the rate w [kg m²/s].
inline Vector3d spin_momentum(const Bodies& b, std::size_t i, const Vector3d& w) {
    const Quaterniond& q = b.orientation[i];
    return q * b.inertia[i].cwiseProduct(q.conjugate() * w);
}

/// Rate at which body i turns over h [s] if constraints change its rate by Δω [rad/s]: as one that
/// is free, with the momentum that it then has.
inline Vector3d pushed_rate(const Bodies& b, std::size_t i, const Vector3d& change, double h) {
    const Quaterniond& q = b.orientation[i];
    const Quaterniond back = q.conjugate();
    const Vector3d momentum =
        back * b.angular_momentum[i] + b.inertia[i].cwiseProduct(back * change);
    return q * middle_rate<double>(momentum, b.inertia[i], b.inverse_inertia[i], h);
}

/// v · I w [J]; with v = w twice the rotational energy at that rate.
inline double inertia_product(const Bodies& b, std::size_t i, const Vector3d& v,
                              const Vector3d& w) {
    const Quaterniond back = b.orientation[i].conjugate();
    return (back * v).cwiseProduct(b.inertia[i]).dot(back * w);
}

/// Of body i, at a velocity and an angular velocity [J].
inline double kinetic_energy(const Bodies& b, std::size_t i, const Vector3d& v, const Vector3d& w) {
    return 0.5 * (b.mass[i] * v.squaredNorm() + inertia_product(b, i, w, w));
}
/// The same by its present ones.
inline double kinetic_energy(const Bodies& b, std::size_t i) {
    return kinetic_energy(b, i, b.velocity[i], b.angular_velocity[i]);
}

}  // namespace plumb
