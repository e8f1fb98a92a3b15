// SPDX-License-Identifier: MIT
/// Ball joint (§5): C(a, b) = a − b = 0 for two points, one on each body.
///
///   r  arm of the point at the start of the substep, world frame [m]
///   h  substep [s]
///
/// Rotation is not linear, so the points are taken at each iteration from the turn of the whole
/// substep, p = x₀ + h v + exp(h ω) r. Where the impulse acts is said in joint_lever.h.
#pragma once

#include "constraints/joint_lever.h"

namespace plumb {

/// Takes the points of two bodies together by Eq. 6: Δ = −M⁻¹Jᵀ (J M⁻¹ Jᵀ)⁻¹ C, as velocities Δ/h
/// (§3, end).
///
///   total_*     whole velocity of the body in this substep
///   change_*    its change since the start of the substep, which is what is corrected
///   gap_before  a − b at the start of the substep [m]
///   lever_*     how the arms of the impulse turn
/// Returns the impulse on a [N s].
template <class T>
inline Vector3<T> join(Velocity<T>& change_a, Velocity<T>& change_b, const Velocity<T>& total_a,
                       const Velocity<T>& total_b, const InverseMass<T>& inverse_a,
                       const InverseMass<T>& inverse_b, const Vector3<T>& r_a,
                       const Vector3<T>& r_b, const Vector3<T>& gap_before,
                       const JointLever<T>& lever_a, const JointLever<T>& lever_b, const T& h) {
    const Vector3<T> turn_a = total_a.w * h, turn_b = total_b.w * h;
    const Vector3<T> c = gap_before + (total_a.v - total_b.v) * h +
                         (Turn<T>(turn_a).change(r_a) - Turn<T>(turn_b).change(r_b));

    const JointArms<T> arms(LeverTurn<T>(lever_a, turn_a), LeverTurn<T>(lever_b, turn_b),
                            lever_b.share, r_a, r_b, gap_before, Vector3<T>(c - gap_before));
    const Symmetric3<T> k = point_response(inverse_a, arms.a) + point_response(inverse_b, arms.b);
    const Vector3<T> impulse = solve_ldlt<T>(k, c) * (T(-1) / h);

    apply_impulse<T>(change_a, inverse_a, arms.a, impulse);
    apply_impulse<T>(change_b, inverse_b, arms.b, -impulse);
    return impulse;
}

}  // namespace plumb
