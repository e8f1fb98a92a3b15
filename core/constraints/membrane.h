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
    /// built up, it throws the sheet across itself, and without bound once h² T q² > 4 m.
    ///
    ///   (s t)  what was pushed, per unit of a and of c, how much of each corner u and w have
    ///   K      the impulses' stress as far as it pulls, Π the directions in which it does
    ///   G      = h Σ w (a c)ᵀ (a c) of the corners
    ///
    /// It should be D = F K − (s t) Π more; corners that yield to that move F by δF = (D + δF K) G,
    /// so δF (1 − K G) = D G. `place` is against the first corner; so are those it moves to.
    static constexpr bool kFollows = true;
    template <class T>
    static void follow(Vector3<T> (&place)[3], Vector3<T> (&velocity)[3], Vector3<T> (&push)[2],
                       const T (&inverse)[kNumbers], const T (&inverse_mass)[3],
                       const T (&impulse)[kRows], const T& h) {
        const T a[3] = {-inverse[0], inverse[0], T(0)},
                c[3] = {-(inverse[1] + inverse[2]), inverse[1], inverse[2]};
        const Vector3<T> e1 = place[1] - place[0], e2 = place[2] - place[0];
        const Vector3<T> u = e1 * inverse[0], w = e1 * inverse[1] + e2 * inverse[2];
        const T long_a = T(1) / inverse[0], long_c = T(1) / inverse[2];
        const Vector3<T> t = push[1] * long_c, s = (push[0] - t * inverse[1]) * long_a;
        T aa = T(0), ac = T(0), cc = T(0);  // of G
        for (int i = 0; i < 3; ++i) {
            const T moved = inverse_mass[i] * h;
            aa += moved * (a[i] * a[i]), ac += moved * (a[i] * c[i]), cc += moved * (c[i] * c[i]);
        }
        const Pull<T> k(impulse);
        const Vector3<T> ds = (u * k.xx + w * k.xy) - (s * k.in_xx + t * k.in_xy),
                         dt = (u * k.xy + w * k.yy) - (s * k.in_xy + t * k.in_yy);
        const Vector3<T> rs = ds * aa + dt * ac, rt = ds * ac + dt * cc;
        const T m00 = T(1) - (k.xx * aa + k.xy * ac), m01 = -(k.xx * ac + k.xy * cc),
                m10 = -(k.xy * aa + k.yy * ac), m11 = T(1) - (k.xy * ac + k.yy * cc);
        const T over = T(1) / (m00 * m11 - m01 * m10);
        const Vector3<T> du = (rs * m11 - rt * m10) * over, dw = (rt * m00 - rs * m01) * over;
        const Vector3<T> s_more = ds + du * k.xx + dw * k.xy, t_more = dt + du * k.xy + dw * k.yy;
        for (int i = 0; i < 3; ++i)
            velocity[i] += (s_more * a[i] + t_more * c[i]) * inverse_mass[i];
        push[0] += s_more * inverse[0] + t_more * inverse[1];
        push[1] += t_more * inverse[2];
        const Vector3<T> side = (u + du) * long_a;
        place[1] = place[0] + side;
        place[2] = place[0] + ((w + dw) - side * inverse[1]) * long_c;
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

private:
    /// The pulling part of impulses' stress, negative as the impulses are that pull, and the
    /// projector onto the directions of it.
    template <class T>
    struct Pull {
        T xx, xy, yy, in_xx, in_xy, in_yy;

        explicit Pull(const T (&impulse)[kRows]) {
            const T radius = sqrt(impulse[1] * impulse[1] + impulse[2] * impulse[2]);
            const T over = T(1) / max(radius, T(1e-20));
            const T x = impulse[1] * over, y = impulse[2] * over;
            const T zero(0), half(0.5);
            const T high = min(impulse[0] + radius, zero), low = min(impulse[0] - radius, zero);
            const T mean = (high + low) * half, swing = (high - low) * half;
            xx = mean + x * swing, xy = y * swing, yy = mean - x * swing;
            // both, the lower alone, or none
            const T all = select_greater(zero, high, T(1), select_greater(zero, low, half, zero));
            const T one = select_greater(zero, high, zero, select_greater(zero, low, half, zero));
            in_xx = all - x * one, in_xy = -(y * one), in_yy = all + x * one;
        }
    };

public:
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
