// SPDX-License-Identifier: MIT
/// Effective mass or inertia of a drive under its joint, which holds meanwhile: about a hinge that
/// is not at the centre of mass it is more than the body's own.
#pragma once

#include "constraints/joint_axis.h"
#include "constraints/joint_rows.h"

namespace plumb {

/// J M⁻¹ Jᵀ of a row along or about an axis [1/kg], [1/(kg m²)].
inline double row_response(const JointCoordinate& q, const InverseMass<double>& a,
                           const InverseMass<double>& b) {
    return (a.mass + b.mass) * q.along.squaredNorm() +
           q.turn_a.dot(Vector3d(a.inertia * q.turn_a)) +
           q.turn_b.dot(Vector3d(b.inertia * q.turn_b));
}

/// 1/(J M⁻¹ Jᵀ − J M⁻¹ Kᵀ (K M⁻¹ Kᵀ + s)⁻¹ K M⁻¹ Jᵀ) with K the rows that the joint takes away, at
/// the start of the substep; 0 where nothing can move.
inline double effective_mass(const JointGeometry<double>& joint, const JointCoordinate& q,
                             const InverseMass<double>& a, const InverseMass<double>& b) {
    const Velocity<double> rest{Vector3d::Zero(), Vector3d::Zero()};
    const JointRows<double> rows = joint_rows<double>(joint, rest, rest, 1);
    const Vector3d on_a = a.inertia * q.turn_a, on_b = b.inertia * q.turn_b;
    double k[6][6], crossed[6], solved[6];
    joint_response<double>(k, rows, joint, a, b);
    for (int i = 0; i < 6; ++i) {
        crossed[i] = rows.g_a[i].dot(on_a) + rows.g_b[i].dot(on_b);
        if (i < 3) crossed[i] += (a.mass + b.mass) * rows.e[i].dot(q.along);
        solved[i] = crossed[i] *= joint.lock[i];
    }
    solve_ldlt<double, 6>(k, solved);
    const double bare = row_response(q, a, b);
    double response = bare;
    for (int i = 0; i < 6; ++i) response -= crossed[i] * solved[i];
    return response > 1e-12 * bare ? 1 / response : 0;
}

}  // namespace plumb
