// SPDX-License-Identifier: MIT
/// Strain of a tetrahedron with two moduli.
///
///   F  how the tetrahedron is mapped; F = R S, with a rotation R and S symmetric
///
///   s  stretches, which are S along its axes
///
///   C  S_xx − S_yy, 2 S_yz, 2 S_zx, 2 S_xy with compliance 1/(μ V),
///      S_xx + S_yy − 2 S_zz with 3/(μ V), Σ (w log s + (1 − w) (s − 1)) with 1/(K V)
///
/// That is Hooke's solid at small strains, with the shear modulus μ and the bulk modulus K, in axes
/// that turn with the tetrahedron. R is a rotation also where that is flat or inside out (Irving et
/// al. 2004), so that it is pushed back to its shape from any other, by forces that neither vanish
/// nor grow without bound. Σ log s is the logarithm of the volume (Hencky), which what is next to
/// incompressible keeps at any strain; Σ (s − 1), its like at small strains, lets what has no
/// lateral contraction have none. w = 3 ν / (1 + ν) is the share of λ in K = λ + ⅔ μ; of auxetic
/// solids, 0. Outside of the range of kLogarithm a logarithm goes on straight. All rows are 0 at
/// rest: those of a solid under stress of its own would have to be turned with it within a substep.
#pragma once

#include "constraints/points.h"
#include "math/logarithm.h"
#include "math/principal_stretches.h"
#include "world/particles.h"

#include <Eigen/LU>

#include <algorithm>

namespace plumb {

struct Tetrahedron {
    static constexpr int kPoints = 4, kRows = 6;
    /// The inverse of the edges at rest, by rows [1/m], and w.
    static constexpr int kNumbers = 10;

    template <class T>
    static PointRows<T, 4, 6> rows(const Vector3<T> (&p)[4], const T (&inverse)[kNumbers]) {
        const PrincipalStretches<T> at = stretches_of<T>(p, inverse);
        const T(&s)[3] = at.stretch;
        Vector3<T> edge[3];
        principal_edges<T>(edge, inverse, at.rest);
        T share[3][3];
        turning_shares<T>(share, s);
        PointRows<T, 4, 6> r;
        for (int row = 0; row < 6; ++row) {
            T d[3][3];  // vᵀ ∂C/∂S v
            r.c[row] = principal_row<T>(row, d, at, inverse[9]);
            Vector3<T> slope[3];  // uᵀ ∂C/∂F v
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) slope[i][j] = T(2) * (share[i][j] * d[i][j]);
            for (int i = 0; i < 3; ++i)
                r.gradient[row][i + 1] = at.now[0] * dot(slope[0], edge[i]) +
                                         at.now[1] * dot(slope[1], edge[i]) +
                                         at.now[2] * dot(slope[2], edge[i]);
            r.gradient[row][0] = -(r.gradient[row][1] + r.gradient[row][2] + r.gradient[row][3]);
        }
        return r;
    }

    /// The stress as far as it pulls, along each principal direction.
    static Eigen::Matrix4d tension(const Vector3d (&p)[4], const double (&inverse)[kNumbers],
                                   const double (&force)[kRows]) {
        const PrincipalStretches<double> at = stretches_of<double>(p, inverse);
        double pull[3] = {};
        for (int row = 0; row < 6; ++row) {
            double d[3][3];
            principal_row<double>(row, d, at, inverse[9]);
            for (int k = 0; k < 3; ++k) pull[k] += force[row] * d[k][k];
        }
        Vector3d edge[3];
        principal_edges<double>(edge, inverse, at.rest);
        Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector4d along(-edge[0][k] - edge[1][k] - edge[2][k], edge[0][k],
                                        edge[1][k], edge[2][k]);
            sum += std::max(pull[k], 0.0) / std::max(at.stretch[k], kLeastSum) * along *
                   along.transpose();
        }
        return sum;
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
            numbers[9] = std::max(0.0, 3 * nu / (1 + nu));
            const double soft = 1 / (shear * volume);
            const double compliances[kRows] = {soft, 3 * soft, soft,
                                               soft, soft,     1 / (bulk * volume)};
            visit(t, numbers, compliances);
        }
    }

private:
    static constexpr int kVolume = 5;  ///< that row
    /// Stretches between which a logarithm is one. Below, a steeper one would hold crushed elements
    /// of little compressibility where they are inside out beside each other; above, a step of
    /// Newton's method would lead beyond 0, and farther each time.
    static constexpr double kLogarithm[2] = {0.5, 2.5};
    /// Below this s_i + s_j the gradients of shear fade out: S turns without bound where a face
    /// turns over. Forces stay finite, and without a torque.
    static constexpr double kLeastSum = 0.1;

    /// vᵀ ∂F/∂p of corners 1 … 3.
    template <class T>
    static void principal_edges(Vector3<T> (&edge)[3], const T (&inverse)[kNumbers],
                                const Vector3<T> (&v)[3]) {
        for (int i = 0; i < 3; ++i) {
            const Vector3<T> corner(inverse[3 * i], inverse[3 * i + 1], inverse[3 * i + 2]);
            for (int k = 0; k < 3; ++k) edge[i][k] = dot(v[k], corner);
        }
    }

    template <class T>
    static PrincipalStretches<T> stretches_of(const Vector3<T> (&p)[4],
                                              const T (&inverse)[kNumbers]) {
        const Vector3<T> e[3] = {p[1] - p[0], p[2] - p[0], p[3] - p[0]};
        Vector3<T> f[3];
        for (int k = 0; k < 3; ++k)
            f[k] = e[0] * inverse[k] + e[1] * inverse[3 + k] + e[2] * inverse[6 + k];
        return principal_stretches_of<T>(f);
    }

    /// From SᵀS = FᵀF: v_iᵀ δS v_j = (s_i u_iᵀ δF v_j + s_j u_jᵀ δF v_i) / (s_i + s_j). The share
    /// of the first term, ½ where i = j.
    template <class T>
    static void turning_shares(T (&share)[3][3], const T (&stretch)[3]) {
        for (int i = 0; i < 3; ++i) {
            share[i][i] = T(0.5);
            for (int j = 0; j < i; ++j) {
                const T inverse = T(1) / max(T(stretch[i] + stretch[j]), T(kLeastSum));
                share[i][j] = stretch[i] * inverse, share[j][i] = stretch[j] * inverse;
            }
        }
    }

    /// Returns C, and vᵀ ∂C/∂S v; `share` is w.
    template <class T>
    static T principal_row(int row, T (&d)[3][3], const PrincipalStretches<T>& at, const T& share) {
        return row == kVolume ? volume_row<T>(d, at.stretch, share)
                              : shear_row<T>(row, d, at.rest, at.stretch);
    }

    template <class T>
    static T shear_row(int row, T (&d)[3][3], const Vector3<T> (&v)[3], const T (&s)[3]) {
        const int y = (row + 2) % 3, z = row % 3;  // of rows 2, 3 and 4
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j <= i; ++j) {
                const T one(i == j ? 1 : 0);
                d[i][j] = row == 0   ? v[i][0] * v[j][0] - v[i][1] * v[j][1]
                          : row == 1 ? one - T(3) * (v[i][2] * v[j][2])
                                     : v[i][y] * v[j][z] + v[i][z] * v[j][y];
                d[j][i] = d[i][j];
            }
        return (d[0][0] * s[0] + d[1][1] * s[1]) + d[2][2] * s[2];
    }

    template <class T>
    static T volume_row(T (&d)[3][3], const T (&stretch)[3], const T& share) {
        T volume(1), beyond(0);
        for (int i = 0; i < 3; ++i) {
            const T some = min(max(stretch[i], T(kLogarithm[0])), T(kLogarithm[1]));
            const T slope = T(1) / some;
            volume *= some, beyond += (stretch[i] - some) * slope;
            for (int j = 0; j < 3; ++j) d[i][j] = T(0);
            d[i][i] = share * slope + (T(1) - share);
        }
        const T logarithm = natural_log(volume) + beyond;
        const T sum = (stretch[0] + stretch[1]) + (stretch[2] - T(3));
        return share * logarithm + (T(1) - share) * sum;
    }
};

}  // namespace plumb
