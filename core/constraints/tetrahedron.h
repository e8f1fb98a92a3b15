// SPDX-License-Identifier: MIT
/// Strain of a tetrahedron with two moduli.
///
///   F  how the tetrahedron is mapped; J = det F; E = ½ (FᵀF − 1)
///   C  E_xx − E_yy, 2 E_yz, 2 E_zx, 2 E_xy with compliance 1/(μ V),
///      E_xx + E_yy − 2 E_zz with 3/(μ V), J − 1 with 1/(K V)
///
/// For small strains that is Hooke's solid with the shear modulus μ and the bulk modulus K. All
/// rows are 0 at rest: those of a solid under stress of its own would have to be turned with it
/// within a substep. E knows no inside and outside, so where J < 0 only the last row acts, and
/// turns it back.
#pragma once

#include "constraints/points.h"
#include "math/lanes.h"
#include "world/particles.h"

#include <Eigen/LU>

namespace plumb {

struct Tetrahedron {
    static constexpr int kPoints = 4, kRows = 6;
    static constexpr int kNumbers = 9;  ///< the inverse of the edges at rest, by rows [1/m]

    template <class T>
    static PointRows<T, 4, 6> rows(const Vector3<T> (&p)[4], const T (&inverse)[kNumbers]) {
        const Vector3<T> e[3] = {p[1] - p[0], p[2] - p[0], p[3] - p[0]};
        Vector3<T> f[3];
        for (int k = 0; k < 3; ++k)
            f[k] = e[0] * inverse[k] + e[1] * inverse[3 + k] + e[2] * inverse[6 + k];
        const Vector3<T> minors[3] = {cross<T>(f[1], f[2]), cross<T>(f[2], f[0]),
                                      cross<T>(f[0], f[1])};
        const T volume = dot(f[0], minors[0]);
        const T upright = select_greater(volume, T(0), T(1), T(0));
        const T half = T(0.5) * upright;
        const T xx = dot(f[0], f[0]), yy = dot(f[1], f[1]), zz = dot(f[2], f[2]);
        PointRows<T, 4, 6> r;
        r.c[0] = (xx - yy) * half, r.c[1] = (xx + yy - (zz + zz)) * half;
        // ∂C/∂f of each row, three vectors
        const Vector3<T> none(T(0), T(0), T(0));
        Vector3<T> slope[6][3] = {
            {f[0] * upright, f[1] * -upright, none},
            {f[0] * upright, f[1] * upright, f[2] * (T(-2) * upright)},
        };
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            r.c[2 + k] = dot(f[i], f[j]) * upright;
            slope[2 + k][i] = f[j] * upright, slope[2 + k][j] = f[i] * upright;
            slope[2 + k][k] = none;
            slope[5][k] = minors[k];
        }
        r.c[5] = volume - T(1);
        for (int row = 0; row < 6; ++row) {
            for (int i = 0; i < 3; ++i)
                r.gradient[row][i + 1] = slope[row][0] * inverse[3 * i] +
                                         slope[row][1] * inverse[3 * i + 1] +
                                         slope[row][2] * inverse[3 * i + 2];
            r.gradient[row][0] = -(r.gradient[row][1] + r.gradient[row][2] + r.gradient[row][3]);
        }
        return r;
    }

    /// The stress of the rows of strain as far as it pulls.
    static Eigen::Matrix4d tension(const Vector3d (&)[4], const double (&inverse)[kNumbers],
                                   const double (&force)[kRows]) {
        Matrix3d stress;
        stress << force[0] + force[1], force[4], force[3],  //
            force[4], force[1] - force[0], force[2],        //
            force[3], force[2], -2 * force[1];
        Eigen::Matrix<double, 3, 4> map;  // of the corners to the axes at rest
        for (int axis = 0; axis < 3; ++axis) {
            map(axis, 0) = 0;
            for (int i = 0; i < 3; ++i) {
                map(axis, i + 1) = inverse[3 * i + axis];
                map(axis, 0) -= inverse[3 * i + axis];
            }
        }
        return map.transpose() * pulling_part<3>(stress) * map;
    }

    /// Calls visit(points, numbers, compliances) for each tetrahedron of a solid.
    template <class Visit>
    static void each(const Deformable& d, Visit visit) {
        if (d.spec.kind != DeformableKind::solid) return;
        const double nu = d.spec.elasticity.poissons_ratio;
        const double shear = d.spec.elasticity.youngs_modulus / (2 * (1 + nu)),
                     bulk = d.spec.elasticity.youngs_modulus / (3 * (1 - 2 * nu));
        for (const auto& t : d.spec.tetrahedra) {
            Matrix3d edges;
            for (int k = 0; k < 3; ++k)
                edges.col(k) = d.spec.points[t[k + 1]] - d.spec.points[t[0]];
            const Matrix3d inverse = edges.inverse();
            const double volume = edges.determinant() / 6;
            double numbers[kNumbers];
            for (int i = 0; i < 9; ++i) numbers[i] = inverse(i / 3, i % 3);
            const double soft = 1 / (shear * volume);
            const double compliances[kRows] = {soft, 3 * soft, soft,
                                               soft, soft,     1 / (bulk * volume)};
            visit(t, numbers, compliances);
        }
    }
};

}  // namespace plumb
