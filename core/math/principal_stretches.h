// SPDX-License-Identifier: MIT
/// Principal stretches of a map of space, over any number type.
///
///   F = Σ s_k u_k v_kᵀ: what lies along v_k at rest is s_k times as long, and along u_k
///
/// v and u are right-handed frames, so that s_0 ≥ s_1 ≥ |s_2|, and s_2 < 0 where F turns space
/// inside out. By one-sided rotations of Jacobi's (Golub and Van Loan, Matrix Computations,
/// §8.6.3), as many for each F, so that lanes go the same way.
#pragma once

#include "math/lanes.h"
#include "math/types.h"

namespace plumb {

template <class T>
struct PrincipalStretches {
    Vector3<T> rest[3], now[3];  ///< v, u
    T stretch[3];
};

namespace principal_stretches {

inline constexpr int kSweeps = 4;  ///< to rounding, of doubles too
/// The square of a stretch below which no direction is read off it.
inline constexpr double kNone = 1e-12;
inline constexpr double kTiny = 1e-30;  ///< keeps quotients of zeros finite

template <class T>
inline void turn_pair(Vector3<T>& a, Vector3<T>& b, const T& cosine, const T& sine) {
    const Vector3<T> turned = a * cosine - b * sine;
    b = b * cosine + a * sine;
    a = turned;
}

/// Turns both pairs so that `a` and `b` are at right angles.
template <class T>
inline void straighten(Vector3<T>& a, Vector3<T>& b, Vector3<T>& rest_a, Vector3<T>& rest_b) {
    const T apart = dot(b, b) - dot(a, a), twice = T(2) * dot(a, b);
    const T size = sqrt(T(apart * apart + twice * twice)) + T(kTiny);
    const T tangent = twice / select_greater(T(0), apart, T(apart - size), T(apart + size));
    const T cosine = T(1) / sqrt(T(T(1) + tangent * tangent)), sine = tangent * cosine;
    turn_pair(a, b, cosine, sine);
    turn_pair(rest_a, rest_b, cosine, sine);
}

/// Swaps both pairs where `b` is longer than `a`; one turns round, so that frames stay
/// right-handed.
template <class T>
inline void put_longer_first(Vector3<T>& a, Vector3<T>& b, Vector3<T>& rest_a, Vector3<T>& rest_b) {
    const T length_a = dot(a, a), length_b = dot(b, b);
    const T sine = select_greater(length_b, length_a, T(1), T(0)), cosine = T(1) - sine;
    turn_pair(a, b, cosine, sine);
    turn_pair(rest_a, rest_b, cosine, sine);
}

template <class T>
inline Vector3<T> select_vector(const T& a, const T& b, const Vector3<T>& x, const Vector3<T>& y) {
    return Vector3<T>(select_greater(a, b, x[0], y[0]), select_greater(a, b, x[1], y[1]),
                      select_greater(a, b, x[2], y[2]));
}

/// `along` at length 1, or `otherwise` where there is next to none of it.
template <class T>
inline Vector3<T> direction(const Vector3<T>& along, const Vector3<T>& otherwise) {
    const T square = dot(along, along);
    const T inverse = T(1) / sqrt(max(square, T(kNone)));
    return select_vector<T>(square, T(kNone), along * inverse, otherwise);
}

/// Some direction at right angles to one.
template <class T>
inline Vector3<T> any_across(const Vector3<T>& u) {
    const Vector3<T> flat(-u[1], u[0], T(0)), upright(T(0), -u[2], u[1]);
    const T flat_square = dot(flat, flat), upright_square = dot(upright, upright);
    const T inverse = T(1) / sqrt(max(flat_square, upright_square));
    return select_vector<T>(flat_square, upright_square, flat, upright) * inverse;
}

}  // namespace principal_stretches

/// Of F, given by its columns.
template <class T>
inline PrincipalStretches<T> principal_stretches_of(const Vector3<T> (&f)[3]) {
    using namespace principal_stretches;
    PrincipalStretches<T> p;
    Vector3<T> g[3] = {f[0], f[1], f[2]};  // F v_k
    for (int k = 0; k < 3; ++k)
        p.rest[k] = Vector3<T>(T(k == 0 ? 1 : 0), T(k == 1 ? 1 : 0), T(k == 2 ? 1 : 0));
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (int k = 0; k < 3; ++k) {
            const int i = k == 2 ? 1 : 0, j = k == 0 ? 1 : 2;
            straighten(g[i], g[j], p.rest[i], p.rest[j]);
        }
    put_longer_first(g[0], g[1], p.rest[0], p.rest[1]);
    put_longer_first(g[1], g[2], p.rest[1], p.rest[2]);
    put_longer_first(g[0], g[1], p.rest[0], p.rest[1]);
    p.now[0] = direction<T>(g[0], p.rest[0]);
    p.now[1] = direction<T>(g[1] - p.now[0] * dot(p.now[0], g[1]), any_across<T>(p.now[0]));
    p.now[2] = cross<T>(p.now[0], p.now[1]);
    for (int k = 0; k < 3; ++k) p.stretch[k] = dot(p.now[k], g[k]);
    return p;
}

}  // namespace plumb
