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

    /// What a taut triangle has pushed turns with it. Left along the gradients along which it was
    /// built up, it throws the sheet across itself; without bound where what swings across it turns
    /// by more than two radians a substep.
    ///
    ///   (s t)  what was pushed: s aᵢ + t cᵢ at corner i, with u = Σ aᵢ pᵢ and w = Σ cᵢ pᵢ
    ///   K      the stress of the summed impulses as far as it pulls, negative as they are
    ///   Π      the projector onto the directions in which it pulls
    ///   G      = h Σ wᵢ (aᵢ cᵢ)ᵀ (aᵢ cᵢ)
    ///
    /// There should be D = F K − (s t) Π more. Corners that yield to that move F by
    /// δF = (D + δF K) G, so δF (1 − K G) = D G; all along the principal axes of K, where each term
    /// of the determinant is positive. `place` is against the first corner.
    /// Slim triangles, of cells from 4 : 1 on, do not follow: it shakes sheets of them.
    static constexpr bool kFollows = true;
    static constexpr double kSlim = 7;
    template <class T>
    static void follow(Vector3<T> (&place)[3], Vector3<T> (&velocity)[3], Vector3<T> (&push)[2],
                       const T (&inverse)[kNumbers], const T (&inverse_mass)[3],
                       const T (&impulse)[kRows], const T& h) {
        const T zero(0), half(0.5), one(1);
        const T radius = sqrt(impulse[1] * impulse[1] + impulse[2] * impulse[2]);
        const T cos_2 = impulse[1] / max(radius, T(1e-20));
        const T cosine = sqrt(max((one + cos_2) * half, zero));
        const T size = sqrt(max((one - cos_2) * half, zero));
        const T sine = select_greater(zero, impulse[2], -size, size);
        const T high = min(impulse[0] + radius, zero), low = min(impulse[0] - radius, zero);

        const T a[3] = {-inverse[0], inverse[0], zero},
                c[3] = {-(inverse[1] + inverse[2]), inverse[1], inverse[2]};
        T high_high = zero, high_low = zero, low_low = zero;  // of G
        for (int i = 0; i < 3; ++i) {
            const T at_high = a[i] * cosine + c[i] * sine, at_low = c[i] * cosine - a[i] * sine;
            const T moved = inverse_mass[i] * h;
            high_high += moved * (at_high * at_high), high_low += moved * (at_high * at_low);
            low_low += moved * (at_low * at_low);
        }
        const T area = inverse[0] * inverse[2] * h;
        const T det_g = area * area *
                        (inverse_mass[0] * (inverse_mass[1] + inverse_mass[2]) +
                         inverse_mass[1] * inverse_mass[2]);

        const Vector3<T> e1 = place[1] - place[0], e2 = place[2] - place[0];
        const Vector3<T> u = e1 * inverse[0], w = e1 * inverse[1] + e2 * inverse[2];
        const T long_a = one / inverse[0], long_c = one / inverse[2];
        const Vector3<T> t = push[1] * long_c, s = (push[0] - t * inverse[1]) * long_a;
        // a² + b² + c² over a c, of the first edge a, and b along and c across it of the second
        const T slim =
            (inverse[2] * inverse[2] + inverse[1] * inverse[1] + inverse[0] * inverse[0]) *
            (long_a * long_c);
        const T follows = select_greater(T(kSlim), slim, one, zero);
        const Vector3<T> d_high =
                             ((u * cosine + w * sine) * high -
                              (s * cosine + t * sine) * select_greater(zero, high, one, zero)) *
                             follows,
                         d_low = ((w * cosine - u * sine) * low -
                                  (t * cosine - s * sine) * select_greater(zero, low, one, zero)) *
                                 follows;

        const T over = one / ((one - high * high_high) - low * low_low + high * low * det_g);
        const Vector3<T> f_high = (d_high * (high_high - low * det_g) + d_low * high_low) * over,
                         f_low = (d_high * high_low + d_low * (low_low - high * det_g)) * over;
        const Vector3<T> more_high = d_high + f_high * high, more_low = d_low + f_low * low;
        const Vector3<T> s_more = more_high * cosine - more_low * sine,
                         t_more = more_high * sine + more_low * cosine;
        for (int i = 0; i < 3; ++i)
            velocity[i] += (s_more * a[i] + t_more * c[i]) * inverse_mass[i];
        push[0] += s_more * inverse[0] + t_more * inverse[1];
        push[1] += t_more * inverse[2];
        const Vector3<T> side = (u + (f_high * cosine - f_low * sine)) * long_a;
        place[1] = place[0] + side;
        place[2] = place[0] + ((w + (f_high * sine + f_low * cosine)) - side * inverse[1]) * long_c;
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
