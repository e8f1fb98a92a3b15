// SPDX-License-Identifier: MIT
/// Connectors (§7): how a constraint's points ride on bodies.
///
///   v w   change of a body's velocity since the start of the substep [m/s], [rad/s]
///   r     arm: from the centre of mass to the point, world frame [m]
///   P     impulse on the body at the point [N s]
///
/// A body point moves by the connector [E, −[r]ₓ]. A constraint is written once, in terms of its
/// points, and so works between any two bodies; immovable ones have zero inverse mass.
#pragma once

#include "math/symmetric.h"
#include "math/types.h"

namespace plumb {

template <class T>
struct Velocity {
    Vector3<T> v, w;
};

template <class T>
struct InverseMass {
    T mass;                 ///< 1/m [1/kg]
    Symmetric3<T> inertia;  ///< I⁻¹, world frame [1/(kg m²)]
};

/// Velocity of the point at arm r.
template <class T>
inline Vector3<T> velocity_at(const Velocity<T>& body, const Vector3<T>& r) {
    return body.v + cross(body.w, r);
}

/// M⁻¹ Jᵀ P: what an impulse at arm r changes (Eq. 6, the factor in front).
template <class T>
inline void apply_impulse(Velocity<T>& body, const InverseMass<T>& inverse, const Vector3<T>& r,
                          const Vector3<T>& p) {
    body.v += p * inverse.mass;
    body.w += inverse.inertia * cross(r, p);
}

/// dᵀ J M⁻¹ Jᵀ e: how fast the point moves along d per unit of impulse along e, for one body.
template <class T>
inline T response(const InverseMass<T>& inverse, const Vector3<T>& r, const Vector3<T>& d,
                  const Vector3<T>& e) {
    return inverse.mass * dot(d, e) + dot(cross(r, d), Vector3<T>(inverse.inertia * cross(r, e)));
}

/// J M⁻¹ Jᵀ of a point, all three directions: E/m − [r]ₓ I⁻¹ [r]ₓ.
template <class T>
inline Symmetric3<T> point_response(const InverseMass<T>& inverse, const Vector3<T>& r) {
    const Symmetric3<T>& i = inverse.inertia;
    // columns of I⁻¹ [r]ₓ
    const Vector3<T> cx(i.xy * r[2] - i.xz * r[1], i.yy * r[2] - i.yz * r[1],
                        i.yz * r[2] - i.zz * r[1]);
    const Vector3<T> cy(i.xz * r[0] - i.xx * r[2], i.yz * r[0] - i.xy * r[2],
                        i.zz * r[0] - i.xz * r[2]);
    const Vector3<T> cz(i.xx * r[1] - i.xy * r[0], i.xy * r[1] - i.yy * r[0],
                        i.xz * r[1] - i.yz * r[0]);
    // minus [r]ₓ times those columns
    return {inverse.mass + (r[2] * cx[1] - r[1] * cx[2]),
            inverse.mass + (r[0] * cy[2] - r[2] * cy[0]),
            inverse.mass + (r[1] * cz[0] - r[0] * cz[1]),
            r[2] * cy[1] - r[1] * cy[2],
            r[2] * cz[1] - r[1] * cz[2],
            r[0] * cz[2] - r[2] * cz[0]};
}

}  // namespace plumb
