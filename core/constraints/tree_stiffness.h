// SPDX-License-Identifier: MIT
/// How the impulses of joints stiffen the turns of the bodies that they act on.
#pragma once

#include "math/lanes.h"
#include "math/matrices.h"
#include "math/symmetric.h"

#include <Eigen/Eigenvalues>

namespace plumb {

/// Stiffness of a turn against an impulse P at arm r, whose torque r × P turns with the arm:
/// −∂(r × P)/∂ω = h ((P·r) E − r Pᵀ), the symmetric part.
template <class T>
inline Symmetric3<T> angular_stiffness(const Vector3<T>& r, const Vector3<T>& p, T h) {
    const Vector3<T> x = r * h;
    const T along = dot(x, p), half = T(0.5);
    return {along - x[0] * p[0],
            along - x[1] * p[1],
            along - x[2] * p[2],
            -half * (x[0] * p[1] + x[1] * p[0]),
            -half * (x[0] * p[2] + x[2] * p[0]),
            -half * (x[1] * p[2] + x[2] * p[1])};
}

/// Greater than 0 where all leading minors are.
template <class T>
inline T least_minor(const Symmetric3<T>& m) {
    const T minor = m.xx * m.yy - m.xy * m.xy;
    const T whole = m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.yz * m.xz) +
                    m.xz * (m.xy * m.yz - m.yy * m.xz);
    return min(m.xx, min(minor, whole));
}

/// Without its negative principal values.
inline Symmetric3<double> non_negative_part(const Symmetric3<double>& g) {
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(matrix_of(g));
    return rotated_diagonal(solver.eigenvectors(), solver.eigenvalues().cwiseMax(0));
}

/// The part of a stiffness that can be trusted beside an inertia: all of it while the two leave at
/// least a quarter of the inertia, else what is not negative.
template <class T>
inline Symmetric3<T> safe_stiffness(const Symmetric3<T>& g, const Symmetric3<T>& inertia) {
    const T share = T(0.75);
    const T room =
        least_minor(g + Symmetric3<T>{share * inertia.xx, share * inertia.yy, share * inertia.zz,
                                      share * inertia.xy, share * inertia.xz, share * inertia.yz});
    if (!any_greater(T(0), room)) return g;
    Symmetric3<T> safe = g;
    for (int lane = 0; lane < kLaneCount<T>; ++lane) {
        if (!(number_of(room, lane) < 0)) continue;
        const auto one = [&](const T& x) { return number_of(x, lane); };
        const Symmetric3<double> part =
            non_negative_part({one(g.xx), one(g.yy), one(g.zz), one(g.xy), one(g.xz), one(g.yz)});
        set_number(safe.xx, lane, part.xx), set_number(safe.yy, lane, part.yy);
        set_number(safe.zz, lane, part.zz), set_number(safe.xy, lane, part.xy);
        set_number(safe.xz, lane, part.xz), set_number(safe.yz, lane, part.yz);
    }
    return safe;
}

}  // namespace plumb
