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

/// 1 where a turn in one step is too far for the laws of free rotation to be followed, else 0.
template <class T>
inline T turns_too_far(const Vector3<T>& rate, const T& h) {
    return select_greater(dot(rate, rate) * (h * h), T(1), T(1), T(0));
}

/// ω in the body's frame; `momentum`: L there [kg m²/s]; `inertia`: principal moments [kg m²].
/// Lanes that have converged stay as they are, so that each has the bits of a number alone. Where
/// a body turns too far for that, ω stays.
template <class T>
inline Vector3<T> middle_rate(const Vector3<T>& momentum, const Vector3<T>& inertia,
                              const Vector3<T>& inverse_inertia, const T& h) {
    constexpr int kMostRounds = 12;
    const Vector3<T> start = inverse_inertia.cwiseProduct(momentum);
    Vector3<T> rate = start;
    T moving = T(1), before = dot(rate, rate);
    for (int round = 0; round < kMostRounds && any_greater(moving, T(0)); ++round) {
        const Vector3<T> seen = unit_exponential<T>(Vector3<T>(rate * (h * T(-0.5)))) * momentum;
        const Vector3<T> error = seen - inertia.cwiseProduct(rate);
        const Vector3<T> change =
            solve_diagonal_and_cross<T>(inertia, Vector3<T>(seen * (h * T(-0.5))), error);
        rate += change * moving;
        const T size = dot(change, change);  // the next one is less by the share of the last two
        moving = select_greater(size * size, dot(rate, rate) * before * T(1e-20), moving, T(0));
        before = size;
    }
    const T lost = max(moving, turns_too_far<T>(start, h));
    for (int k = 0; k < 3; ++k) rate[k] = select_greater(lost, T(0), start[k], rate[k]);
    return rate;
}

/// What keeps the energy of a body that turns too far: the factor of its momentum, which was at
/// `before` in the body's frame and is at `after`.
template <class T>
inline T energy_correction(const Vector3<T>& before, const Vector3<T>& after,
                           const Vector3<T>& inverse_inertia) {
    return sqrt(dot(before, Vector3<T>(inverse_inertia.cwiseProduct(before))) /
                dot(after, Vector3<T>(inverse_inertia.cwiseProduct(after))));
}

}  // namespace plumb
