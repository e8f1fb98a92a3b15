// SPDX-License-Identifier: MIT
/// Rolling and spinning friction: torques against turning at a contact, bounded by a lever times
/// the push.
///
///   w  angular velocity of a against b [rad/s]
///   τ  summed torque impulse on a [N m s]; across the normal |τ| ≤ ρ λ, about it |τ| ≤ σ λ
///   ρ σ  levers of rolling and of spinning friction [m]
#pragma once

#include "constraints/connector.h"
#include "constraints/friction.h"

namespace plumb {

template <class T>
inline void apply_torque(Velocity<T>& body, const InverseMass<T>& inverse,
                         const Vector3<T>& torque) {
    body.w += inverse.inertia * torque;
}

/// How fast a turns against b about `axis` per unit of torque impulse about it.
template <class T>
inline T turning_response(const InverseMass<T>& a, const InverseMass<T>& b,
                          const Vector3<T>& axis) {
    return dot(axis, Vector3<T>((a.inertia + b.inertia) * axis));
}

/// Adds to τ what stops the turning rate w about one axis, within ±bound, and returns what was
/// added.
template <class T>
inline T resist_spin(T& torque, const T& w, const T& effective_inertia, const T& bound) {
    const T before = torque;
    torque = max(-bound, min(bound, before - effective_inertia * w));
    return torque - before;
}

}  // namespace plumb
