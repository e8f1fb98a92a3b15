// SPDX-License-Identifier: MIT
/// Strain of a tetrahedron with two moduli: a Neo-Hookean solid that keeps its stiffness when it is
/// turned inside out (Smith et al. 2018, as two constraints after Macklin and Müller 2021).
///
///   F            how the tetrahedron is mapped; J = det F
///   C_D = √(F:F)                       with compliance 1/(μ V)
///   C_H = J − 1 − μ/λ                  with compliance 1/(λ V)
///
/// At rest the two pull against each other and nothing is left; for small strains the solid is
/// Hooke's with Lamé's moduli μ and λ − μ.
#pragma once

#include "constraints/points.h"
#include "world/particles.h"

#include <Eigen/LU>

namespace plumb {

struct Tetrahedron {
    static constexpr int kPoints = 4, kRows = 2;
    /// The inverse of the edges at rest, by rows [1/m], and 1 + μ/λ.
    static constexpr int kNumbers = 10;

    template <class T>
    static PointRows<T, 4, 2> rows(const Vector3<T> (&p)[4], const T (&numbers)[kNumbers]) {
        const Vector3<T> e[3] = {p[1] - p[0], p[2] - p[0], p[3] - p[0]};
        Vector3<T> f[3];
        for (int k = 0; k < 3; ++k)
            f[k] = e[0] * numbers[k] + e[1] * numbers[3 + k] + e[2] * numbers[6 + k];
        const Vector3<T> minors[3] = {cross<T>(f[1], f[2]), cross<T>(f[2], f[0]),
                                      cross<T>(f[0], f[1])};
        PointRows<T, 4, 2> r;
        const T size = sqrt(dot(f[0], f[0]) + (dot(f[1], f[1]) + dot(f[2], f[2])));
        const T inverse = T(1) / max(size, T(1e-6));
        r.c[0] = size;
        r.c[1] = dot(f[0], minors[0]) - numbers[9];
        for (int i = 0; i < 3; ++i) {
            const T* d = numbers + 3 * i;
            r.gradient[0][i + 1] = (f[0] * d[0] + f[1] * d[1] + f[2] * d[2]) * inverse;
            r.gradient[1][i + 1] = minors[0] * d[0] + minors[1] * d[1] + minors[2] * d[2];
        }
        for (auto& row : r.gradient) row[0] = -(row[1] + row[2] + row[3]);
        return r;
    }

    /// Calls visit(points, numbers, compliances) for each tetrahedron of a solid.
    template <class Visit>
    static void each(const Deformable& d, Visit visit) {
        if (d.spec.kind != DeformableKind::solid) return;
        const double nu = d.spec.elasticity.poissons_ratio;
        const double mu = d.spec.elasticity.youngs_modulus / (2 * (1 + nu));
        const double lambda = mu / (1 - 2 * nu);  // Lamé's first modulus + μ
        for (const auto& t : d.spec.tetrahedra) {
            Matrix3d edges;
            for (int k = 0; k < 3; ++k)
                edges.col(k) = d.spec.points[t[k + 1]] - d.spec.points[t[0]];
            const Matrix3d inverse = edges.inverse();
            const double volume = edges.determinant() / 6;
            double numbers[kNumbers];
            for (int i = 0; i < 9; ++i) numbers[i] = inverse(i / 3, i % 3);
            numbers[9] = 1 + mu / lambda;
            const double compliances[2] = {1 / (mu * volume), 1 / (lambda * volume)};
            visit(t, numbers, compliances);
        }
    }
};

}  // namespace plumb
