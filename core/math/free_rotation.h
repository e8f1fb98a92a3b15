// SPDX-License-Identifier: MIT
/// The rotation of a free body over a step of h, with its angular momentum kept.
///
/// The rate of the step's middle, ω = R_m I⁻¹ R_mᵀ L with R_m = exp(h ω / 2) R. In the body's frame
/// the half turn leaves ω as it is, so that I ω = exp(−h ω / 2) L: three equations, solved by
/// Newton's method with the derivative E − (h/2) [exp(−h ω / 2) L]ₓ, which is right to first order
/// in the turn.
#pragma once

#include "math/rotation.h"

namespace plumb {

/// Solves (diag(d) + [a]ₓ) x = f.
template <class T>
inline Vector3<T> solve_diagonal_and_cross(const Vector3<T>& d, const Vector3<T>& a,
                                           const Vector3<T>& f) {
    const Vector3<T> minor(d[1] * d[2], d[0] * d[2], d[0] * d[1]),
        da(d[0] * a[0], d[1] * a[1], d[2] * a[2]);
    const T determinant = d[0] * minor[0] + dot(da, a);
    const T along = dot(a, f);
    const Vector3<T> x =
        a * along + Vector3<T>(minor[0] * f[0], minor[1] * f[1], minor[2] * f[2]) + cross(f, da);
    return x * (T(1) / determinant);
}

/// ω in the body's frame; `momentum`: L there [kg m²/s]; `inertia`: principal moments [kg m²].
/// Lanes that have converged stay as they are, so that each has the bits of a number alone.
template <class T>
inline Vector3<T> middle_rate(const Vector3<T>& momentum, const Vector3<T>& inertia,
                              const Vector3<T>& inverse_inertia, const T& h) {
    constexpr int kMostRounds = 12;
    Vector3<T> rate = inverse_inertia.cwiseProduct(momentum);
    T moving = T(1);
    for (int round = 0; round < kMostRounds && any_greater(moving, T(0)); ++round) {
        const Vector3<T> seen = unit_exponential<T>(Vector3<T>(rate * (h * T(-0.5)))) * momentum;
        const Vector3<T> error = seen - inertia.cwiseProduct(rate);
        const Vector3<T> change =
            solve_diagonal_and_cross<T>(inertia, Vector3<T>(seen * (h * T(-0.5))), error);
        rate += change * moving;
        moving = select_greater(dot(change, change), dot(rate, rate) * T(1e-20), moving, T(0));
    }
    return rate;
}

}  // namespace plumb
