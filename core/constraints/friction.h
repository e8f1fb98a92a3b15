// SPDX-License-Identifier: MIT
/// Coulomb friction (§6) in the two directions across the normal, as one block.
///
///   t₁ t₂  unit tangents, t₁ × … right-handed with the normal
///   u      velocity of a against b along t₁, t₂ [m/s]
///   f      summed friction impulse along t₁, t₂ [N s], |f| ≤ μ λ: a round cone, not a pyramid
#pragma once

#include "math/lanes.h"
#include "math/types.h"

namespace plumb {

template <class T>
struct Planar {
    T x, y;
};

/// What friction sees of the bodies' inertia across the normal.
template <class T>
struct TangentMass {
    T xx, xy, yy;  ///< inverse of K, the 2 × 2 response of the point [kg]
    T least;       ///< 1 / greatest eigenvalue of K [kg]
};

/// From the entries of K [1/kg]; `inverse` is 1/x where x > 0, else 0.
template <class T, class Inverse>
inline TangentMass<T> tangent_mass(const T& xx, const T& xy, const T& yy, Inverse inverse) {
    const T half = T(0.5) * (xx - yy);
    const T greatest = T(0.5) * (xx + yy) + sqrt(half * half + xy * xy);
    const T determinant = inverse(xx * yy - xy * xy);
    return {yy * determinant, -xy * determinant, xx * determinant, inverse(greatest)};
}

/// A unit vector across n, without a branch (any lane): the axis least along n, made orthogonal.
template <class T>
inline Vector3<T> tangent_of(const Vector3<T>& n) {
    // two candidates, n × z and n × x; each is safe where the other is not
    const T use_z = select_greater(T(0.5), n[2] * n[2], T(1), T(0));
    const Vector3<T> candidate(use_z * n[1], (T(1) - use_z) * n[2] - use_z * n[0],
                               (use_z - T(1)) * n[1]);
    const T squared = dot(candidate, candidate);
    const T scale = T(1) / sqrt(max(squared, T(1e-20)));
    return candidate * scale;
}

/// Nearest point to f in the disc of the given radius.
template <class T>
inline Planar<T> project_on_disc(const Planar<T>& f, const T& radius) {
    const T length = sqrt(f.x * f.x + f.y * f.y);
    const T scale = select_greater(length, radius, radius / max(length, T(1e-30)), T(1));
    return {f.x * scale, f.y * scale};
}

/// Adds to f what stops the velocity u, keeps `other` + f inside of the cone, and returns what was
/// added. `other` is friction of the other pass that shares the same cone, or zero.
///
/// A contact that can stick is solved as a block. One that slides goes along −u by the least mass
/// of any direction and back onto the cone, so that friction comes to oppose the sliding: the
/// block's step would settle where K⁻¹ u, not u, is along f, and brake too little.
template <class T>
inline Planar<T> solve_friction(Planar<T>& f, const Planar<T>& other, const Planar<T>& u,
                                const TangentMass<T>& mass, const T& bound) {
    const Planar<T> now{other.x + f.x, other.y + f.y};
    const Planar<T> stick{now.x - (mass.xx * u.x + mass.xy * u.y),
                          now.y - (mass.xy * u.x + mass.yy * u.y)};
    const Planar<T> slide =
        project_on_disc<T>({now.x - mass.least * u.x, now.y - mass.least * u.y}, bound);
    const T wish = stick.x * stick.x + stick.y * stick.y, most = bound * bound;
    const Planar<T> before = f;
    f = {select_greater(wish, most, slide.x, stick.x) - other.x,
         select_greater(wish, most, slide.y, stick.y) - other.y};
    return {f.x - before.x, f.y - before.y};
}

}  // namespace plumb
