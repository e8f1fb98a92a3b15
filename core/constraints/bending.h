// SPDX-License-Identifier: MIT
/// Bending of cloth about an inner edge, of length l between two triangles of area A together; its
/// flexural rigidity is B. Both forms below have the energy ½ B l²/A θ² for small angles θ, which
/// is that of a plate bent along its edges.
///
/// Isometric (Bergou et al. 2006), for sheets that are flat at rest: C = Σ cᵢ pᵢ with the cotangent
/// weights of the rest shape. It is l θ for small angles, and linear in the points. Compliance A/B.
///
/// Dihedral, for what is curved at rest: C = 2 sin ½(θ − θ₀), the sine of the half so that it grows
/// up to half a turn. Compliance A/(B l²).
#pragma once

#include "constraints/points.h"
#include "geometry/inner_edges.h"
#include "world/particles.h"

#include <algorithm>
#include <cmath>

namespace plumb {

namespace bending {

/// An angle at rest below which an edge counts as flat [rad].
inline constexpr double kFlat = 1e-6;

/// How much of a whole turn's sine and cosine an edge has: the angle between the triangles'
/// normals, positive where the edge is a ridge.
struct EdgeAngle {
    double sine, cosine;
};

inline EdgeAngle angle_at(const Vector3d (&p)[4]) {
    const Vector3d e = (p[1] - p[0]).normalized();
    const Vector3d n1 = (p[1] - p[0]).cross(p[2] - p[0]).normalized(),
                   n2 = (p[3] - p[0]).cross(p[1] - p[0]).normalized();
    return {n1.cross(n2).dot(e), n1.dot(n2)};
}

/// Calls visit(points, positions, compliance of l θ) for each inner edge that is, or is not, flat.
template <class Visit>
inline void each_edge(const Deformable& d, bool flat, Visit visit) {
    if (d.spec.kind != DeformableKind::cloth && d.spec.kind != DeformableKind::balloon) return;
    const double rigidity = cloth_bending_stiffness(d.spec);
    if (!(rigidity > 0)) return;
    for (const std::array<std::uint32_t, 4>& edge : inner_edges(d.spec.triangles)) {
        Vector3d p[4];
        for (int i = 0; i < 4; ++i) p[i] = d.spec.points[edge[i]];
        if ((std::abs(angle_at(p).sine) < kFlat && angle_at(p).cosine > 0) != flat) continue;
        const double area = 0.5 * ((p[1] - p[0]).cross(p[2] - p[0]).norm() +
                                   (p[1] - p[0]).cross(p[3] - p[0]).norm());
        visit(edge, p, area / rigidity);
    }
}

}  // namespace bending

struct IsometricBend {
    static constexpr int kPoints = 4;

    /// Calls visit(points, weights, compliance) for each inner edge that is flat at rest.
    template <class Visit>
    static void each(const Deformable& d, Visit visit) {
        bending::each_edge(d, true, [&](const auto& edge, const Vector3d(&p)[4], double soft) {
            const auto cotangent = [&](int at, int to, int beside) {
                const Vector3d a = p[to] - p[at], b = p[beside] - p[at];
                return a.dot(b) / a.cross(b).norm();
            };
            const double at_0 = cotangent(0, 1, 2) + cotangent(0, 1, 3),
                         at_1 = cotangent(1, 0, 2) + cotangent(1, 0, 3);
            const double weights[4] = {at_1, at_0, -cotangent(0, 1, 2) - cotangent(1, 0, 2),
                                       -cotangent(0, 1, 3) - cotangent(1, 0, 3)};
            visit(edge, weights, soft);
        });
    }
};

struct DihedralBend {
    static constexpr int kPoints = 4, kRows = 1;
    static constexpr int kNumbers = 2;  ///< sine and cosine of θ₀

    template <class T>
    static PointRows<T, 4, 1> rows(const Vector3<T> (&p)[4], const T (&rest)[kNumbers]) {
        const Vector3<T> e = p[1] - p[0];
        const Vector3<T> n1 = cross<T>(e, Vector3<T>(p[2] - p[0])),
                         n2 = cross<T>(Vector3<T>(p[3] - p[0]), e);
        const T length = max(T(sqrt(dot(e, e))), T(1e-12));
        const T area1 = max(dot(n1, n1), T(1e-24)), area2 = max(dot(n2, n2), T(1e-24));
        const T scale = T(1) / (sqrt(area1) * sqrt(area2));
        const T sine = dot(cross<T>(n1, n2), e) * (scale / length), cosine = dot(n1, n2) * scale;
        const T apart = sine * rest[1] - cosine * rest[0],  // sin, cos (θ − θ₀)
            along = cosine * rest[1] + sine * rest[0];
        const T half = sqrt(max(T(0.5) * (T(1) + along), T(1e-4)));  // cos ½(θ − θ₀)
        PointRows<T, 4, 1> r;
        r.c[0] = apart / half;
        // ∂θ/∂p, of the points across the edge along the normals over the heights
        const Vector3<T> g2 = n1 * (length / area1 * -half), g3 = n2 * (length / area2 * -half);
        const T share2 = dot(Vector3<T>(p[2] - p[0]), e) / (length * length),
                share3 = dot(Vector3<T>(p[3] - p[0]), e) / (length * length);
        r.gradient[0][2] = g2, r.gradient[0][3] = g3;
        r.gradient[0][1] = -(g2 * share2 + g3 * share3);
        r.gradient[0][0] = -(g2 * (T(1) - share2) + g3 * (T(1) - share3));
        return r;
    }

    /// Calls visit(points, numbers, compliances) for each inner edge that is bent at rest.
    template <class Visit>
    static void each(const Deformable& d, Visit visit) {
        bending::each_edge(d, false, [&](const auto& edge, const Vector3d(&p)[4], double soft) {
            const bending::EdgeAngle angle = bending::angle_at(p);
            const double numbers[2] = {angle.sine, angle.cosine};
            const double compliances[1] = {soft / (p[1] - p[0]).squaredNorm()};
            visit(edge, numbers, compliances);
        });
    }
};

}  // namespace plumb
