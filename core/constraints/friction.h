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

/// Inverse of a symmetric 2 × 2 matrix.
template <class T>
struct PlanarBlock {
    T xx, xy, yy;
    Planar<T> operator*(const Planar<T>& v) const {
        return {xx * v.x + xy * v.y, xy * v.x + yy * v.y};
    }
};

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

/// Adds to f what stops the velocity u, keeps `held` + f inside of the cone, and returns what was
/// added.
///
/// `held` is friction of the other pass that shares the same cone, or zero.
template <class T>
inline Planar<T> rub(Planar<T>& f, const Planar<T>& held, const Planar<T>& u,
                     const PlanarBlock<T>& effective_mass, const T& bound) {
    const Planar<T> wish = effective_mass * u;
    const Planar<T> total =
        project_on_disc<T>({(held.x + f.x) - wish.x, (held.y + f.y) - wish.y}, bound);
    const Planar<T> before = f;
    f = {total.x - held.x, total.y - held.y};
    return {f.x - before.x, f.y - before.y};
}

}  // namespace plumb
