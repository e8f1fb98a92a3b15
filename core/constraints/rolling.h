// SPDX-License-Identifier: MIT
/// Rolling and spinning friction: torques against the relative rotation at a contact, bounded by a
/// lever times the push.
///
///   w  angular velocity of a against b [rad/s]
///   τ  summed torque impulse on a [N m s]; across the normal |τ| ≤ ρ λ, about it |τ| ≤ σ λ
///   ρ σ  levers of rolling and of spinning friction [m]
///
/// Across the normal the bound is a disc, as that of friction is, and the torque follows the same
/// rule (constraints/friction.h): it does not depend on how the tangents lie.
#pragma once

#include "constraints/connector.h"
#include "constraints/friction.h"

namespace plumb {

template <class T>
inline void apply_torque(Velocity<T>& body, const InverseMass<T>& inverse,
                         const Vector3<T>& torque) {
    body.w += inverse.inertia * torque;
}

/// How fast a turns against b about `d` per unit of torque impulse about `e`.
template <class T>
inline T angular_response(const InverseMass<T>& a, const InverseMass<T>& b, const Vector3<T>& d,
                          const Vector3<T>& e) {
    return dot(d, Vector3<T>((a.inertia + b.inertia) * e));
}

/// What rolling friction sees of the bodies' inertia across the normal [kg m²], from the entries of
/// the 2 × 2 response [1/(kg m²)]; `inverse` is 1/x where x > 0, else 0. Friction's block on
/// entries of size 1: a determinant of inertias would leave the range of single precision.
template <class T, class Inverse>
inline TangentMass<T> rolling_inertia(const T& xx, const T& xy, const T& yy, Inverse inverse) {
    const T size = inverse(xx + yy);
    const TangentMass<T> m = tangent_mass<T>(xx * size, xy * size, yy * size, inverse);
    return {m.xx * size, m.xy * size, m.yy * size, m.least * size};
}

/// Adds to τ what stops the angular rate w about one axis, within ±bound, and returns what was
/// added.
template <class T>
inline T resist_spin(T& torque, const T& w, const T& effective_inertia, const T& bound) {
    const T before = torque;
    torque = max(-bound, min(bound, before - effective_inertia * w));
    return torque - before;
}

}  // namespace plumb
