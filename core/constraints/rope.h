// SPDX-License-Identifier: MIT
/// Ropes: the length of a segment, and how two segments bend against each other.
#pragma once

#include "constraints/points.h"
#include "world/particles.h"

#include <algorithm>
#include <cmath>

namespace plumb {

/// C = |p_b − p_a| − L, with compliance L / (E A).
struct Stretch {
    static constexpr int kPoints = 2, kRows = 1;
    static constexpr int kNumbers = 1;  ///< L [m]

    template <class T>
    static PointRows<T, 2, 1> rows(const Vector3<T> (&p)[2], const T (&numbers)[1]) {
        const Vector3<T> e = p[1] - p[0];
        const T length = sqrt(dot(e, e));
        PointRows<T, 2, 1> r;
        r.c[0] = length - numbers[0];
        r.gradient[0][1] = e * (T(1) / max(length, T(1e-12)));
        r.gradient[0][0] = -r.gradient[0][1];
        return r;
    }

    /// A pull runs on from segment to segment.
    template <class T>
    static T share(const T (&)[1]) {
        return T(1);
    }

    /// What a taut segment has pushed turns with it, as in Membrane::follow: D = n P − push,
    /// δe (1 − P/|e| G) = D G, with G = h Σ w.
    static constexpr bool kFollows = true;
    template <class T>
    static void follow(Vector3<T> (&place)[2], Vector3<T> (&velocity)[2], Vector3<T> (&push)[1],
                       const T (&)[kNumbers], const T (&inverse_mass)[2], const T (&impulse)[1],
                       const T& h) {
        const Vector3<T> e = place[1] - place[0];
        const T k = min(impulse[0], T(0)) / max(sqrt(dot(e, e)), T(1e-12));
        const T pulls = select_greater(T(0), impulse[0], T(1), T(0));
        const T moved = (inverse_mass[0] + inverse_mass[1]) * h;
        const Vector3<T> missing = e * k - push[0] * pulls;
        const Vector3<T> yields = missing * (moved / (T(1) - k * moved));
        const Vector3<T> more = missing + yields * k;
        velocity[0] -= more * inverse_mass[0];
        velocity[1] += more * inverse_mass[1];
        push[0] += more;
        place[1] += yields;
    }

    /// A pull stiffens the segment across it.
    static Eigen::Matrix2d tension(const Vector3d (&p)[2], const double (&)[kNumbers],
                                   const double (&force)[1]) {
        const double pull = std::max(0.0, force[0]) / std::max((p[1] - p[0]).norm(), 1e-12);
        return (Eigen::Matrix2d() << pull, -pull, -pull, pull).finished();
    }

    template <class Visit>
    static void each(const Deformable& d, Visit visit) {
        if (d.spec.kind != DeformableKind::rope) return;
        for (const auto& s : d.spec.segments) {
            const double numbers[1] = {(d.spec.points[s[1]] - d.spec.points[s[0]]).norm()};
            const double compliances[1] = {
                numbers[0] / (d.spec.elasticity.youngs_modulus * rope_section(d.spec))};
            visit(s, numbers, compliances);
        }
    }
};

/// C = (p_a − p_b)/l_a + (p_c − p_b)/l_c, the curvature times the mean length l̄ of two segments
/// that lie in line at rest; with compliance l̄ / (E I).
struct RopeBend {
    static constexpr int kPoints = 3;

    template <class Visit>
    static void each(const Deformable& d, Visit visit) {
        const double stiffness = rope_bending_stiffness(d.spec);
        if (d.spec.kind != DeformableKind::rope || !(stiffness > 0)) return;
        each_corner(d.spec, [&](const std::array<std::uint32_t, 3>& p) {
            const double a = (d.spec.points[p[0]] - d.spec.points[p[1]]).norm(),
                         c = (d.spec.points[p[2]] - d.spec.points[p[1]]).norm();
            const double weights[3] = {1 / a, -1 / a - 1 / c, 1 / c};
            visit(p, weights, 0.5 * (a + c) / stiffness);
        });
    }
};

}  // namespace plumb
