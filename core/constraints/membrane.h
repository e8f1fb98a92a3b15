// SPDX-License-Identifier: MIT
/// Stretch and shear of cloth: Green's strain of a triangle, with the stiffness of a sheet in plane
/// stress.
///
///   F = [u w]  how the triangle's two axes at rest are mapped; E = ½ (FᵀF − 1)
///   C = (E_xx + E_yy, E_xx − E_yy, 2 E_xy)
///
/// In these the energy of a sheet of thickness t, ½ t A E : D : E, has no mixed terms, so each row
/// has a compliance of its own: 2 (1 − ν) / (E t A), and twice 2 (1 + ν) / (E t A).
#pragma once

#include "constraints/points.h"
#include "world/particles.h"

namespace plumb {

struct Membrane {
    static constexpr int kPoints = 3, kRows = 3;
    /// The inverse of the edges at rest, an upper triangle [1/m].
    static constexpr int kNumbers = 3;

    template <class T>
    static PointRows<T, 3, 3> rows(const Vector3<T> (&p)[3], const T (&inverse)[kNumbers]) {
        const Vector3<T> e1 = p[1] - p[0], e2 = p[2] - p[0];
        const Vector3<T> u = e1 * inverse[0], w = e1 * inverse[1] + e2 * inverse[2];
        const T uu = dot(u, u) * T(0.5), ww = dot(w, w) * T(0.5);
        PointRows<T, 3, 3> r;
        r.c[0] = uu + ww - T(1), r.c[1] = uu - ww, r.c[2] = dot(u, w);
        const Vector3<T> along[3] = {u, u, w}, across[3] = {w, -w, u};  // ∂C/∂u, ∂C/∂w
        for (int k = 0; k < 3; ++k) {
            r.gradient[k][1] = along[k] * inverse[0] + across[k] * inverse[1];
            r.gradient[k][2] = across[k] * inverse[2];
            r.gradient[k][0] = -(r.gradient[k][1] + r.gradient[k][2]);
        }
        return r;
    }

    /// Impulses of the rows under one stress are as the areas.
    template <class T>
    static T share(const T (&inverse)[kNumbers]) {
        return T(0.5) / (inverse[0] * inverse[2]);
    }
    /// The rows along axes turned in the plane by θ.
    template <class Row, class T>
    static void turn(Row (&rows)[kRows], const T& cos_2, const T& sin_2) {
        const Row second = rows[1];
        rows[1] = cos_2 * second + sin_2 * rows[2];
        rows[2] = cos_2 * rows[2] - sin_2 * second;
    }

    /// The stress as far as it pulls: what is pressed buckles, and is not made stiffer by it.
    static Matrix3d tension(const Vector3d (&)[3], const double (&inverse)[kNumbers],
                            const double (&force)[kRows]) {
        const Eigen::Matrix2d stress =
            (Eigen::Matrix2d() << force[0] + force[1], force[2], force[2], force[0] - force[1])
                .finished();
        Eigen::Matrix<double, 2, 3> map;  // of the corners to u and w
        map << -inverse[0], inverse[0], 0, -inverse[1] - inverse[2], inverse[1], inverse[2];
        return map.transpose() * pulling_part<2>(stress) * map;
    }

    /// Calls visit(points, numbers, compliances) for each triangle of cloth and balloons.
    template <class Visit>
    static void each(const Deformable& d, Visit visit) {
        if (d.spec.kind != DeformableKind::cloth && d.spec.kind != DeformableKind::balloon) return;
        const double modulus = d.spec.elasticity.youngs_modulus * d.spec.thickness;
        const double nu = d.spec.elasticity.poissons_ratio;
        for (const auto& t : d.spec.triangles) {
            const Vector3d e1 = d.spec.points[t[1]] - d.spec.points[t[0]],
                           e2 = d.spec.points[t[2]] - d.spec.points[t[0]];
            const double a = e1.norm(), b = e1.dot(e2) / a, c = e1.cross(e2).norm() / a;
            const double soft = 2 / (modulus * 0.5 * a * c);
            const double numbers[3] = {1 / a, -b / (a * c), 1 / c};
            const double compliances[3] = {soft * (1 - nu), soft * (1 + nu), soft * (1 + nu)};
            visit(t, numbers, compliances);
        }
    }
};

}  // namespace plumb
