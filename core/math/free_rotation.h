// SPDX-License-Identifier: MIT
/// The rotation of a body over a step of h, with its angular momentum kept.
///
/// What nothing pushed is turned with L constant, in as many parts as its rate asks for
/// (`free_turn`).
///
/// What constraints push has one rate for the whole step, so that they can be solved for the pose
/// at its end (`middle_rate`): the rate of the step's middle, ω = R_m I⁻¹ R_mᵀ L with R_m = exp(h ω
/// / 2) R. In the body's frame the half turn leaves ω as it is, so that I ω = exp(−h ω / 2) L:
/// three equations, solved by Newton's method with the derivative E − (h/2) [exp(−h ω / 2) L]ₓ,
/// which is right to first order in the turn.
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

/// Parts in which a free body is turned over h, so that none is more than kPart: from the fastest
/// that its momentum and energy allow. With the inverse moments between a and b, w² ≤ (a + b) w·L −
/// a b L². At most kMostParts: what is faster turns in longer parts, momentum and energy kept.
template <class T>
inline T part_count(const Vector3<T>& momentum, const Vector3<T>& inverse_inertia, const T& h) {
    constexpr double kPart = 0.25;  // [rad]
    constexpr double kMostParts = 400;
    constexpr double kWhole = 6755399441055744.0;  // 1.5 · 2⁵²: a sum with it has no fraction
    const Vector3<T>& i = inverse_inertia;
    const T a = min(i[0], min(i[1], i[2])), b = max(i[0], max(i[1], i[2]));
    const T work = dot(momentum, Vector3<T>(i.cwiseProduct(momentum)));
    const T fastest = sqrt(max((a + b) * work - a * b * dot(momentum, momentum), T(0)));
    const T wanted = min(fastest * h * T(1 / kPart) + T(0.5), T(kMostParts));
    return max((wanted + T(kWhole)) - T(kWhole), T(1));
}

/// The turn of a free body over h in its own frame, so that R₁ = R₀ · turn, by `parts` steps of
/// fourth order: the commutator-free method of Celledoni, Marthinsen and Owren (2003) on L seen
/// from the body, l′ = −I⁻¹l × l. `l` is L at the start, then at the end.
template <class T>
inline UnitQuaternion<T> turn_in_parts(Vector3<T>& l, const Vector3<T>& inverse_inertia, const T& h,
                                       const T& parts) {
    const T part = h / parts, half = part * T(0.5), twelfth = part * T(1.0 / 12);
    const auto rate = [&](const Vector3<T>& x) {
        return Vector3<T>(inverse_inertia.cwiseProduct(x));
    };
    const auto turn = [](const Vector3<T>& w, const T& time) {
        return unit_exponential<T>(Vector3<T>(w * time));
    };
    UnitQuaternion<T> whole{Vector3<T>(T(0), T(0), T(0)), T(1)};
    for (T done = T(0); any_greater(parts, done + T(0.5)); done = done + T(1)) {
        const Vector3<T> k1 = rate(l);
        const Vector3<T> at2 = turn(k1, half).inverse() * l, k2 = rate(at2);
        const Vector3<T> k3 = rate(turn(k2, half).inverse() * l);
        const Vector3<T> k4 = rate(turn(Vector3<T>(k3 * T(2) - k1), half).inverse() * at2);
        const Vector3<T> middle = (k2 + k3) * T(2);
        const UnitQuaternion<T> first = turn(Vector3<T>(k1 * T(3) + middle - k4), twelfth),
                                second = turn(Vector3<T>(k4 * T(3) + middle - k1), twelfth);
        const UnitQuaternion<T> next = whole * (first * second);
        const Vector3<T> seen = second.inverse() * (first.inverse() * l);
        for (int k = 0; k < 3; ++k) {
            whole.v[k] = select_greater(parts, done + T(0.5), next.v[k], whole.v[k]);
            l[k] = select_greater(parts, done + T(0.5), seen[k], l[k]);
        }
        whole.w = select_greater(parts, done + T(0.5), next.w, whole.w);
    }
    return whole;
}

/// The least turn, in the body's frame, after which L seen from there has w·L = `work` again [J]:
/// up or down the slope of the energy on the sphere |L| = const. `l` is L before, then after it.
///
/// About a principal axis there is no slope, and next to nothing to correct; a little beside the
/// slope keeps rounding from being divided by it.
template <class T>
inline UnitQuaternion<T> energy_correction(Vector3<T>& l, const Vector3<T>& inverse_inertia,
                                           const T& work) {
    constexpr int kRounds = 3;
    constexpr double kFlat = 1e-14;  // of the rate, squared
    UnitQuaternion<T> whole{Vector3<T>(T(0), T(0), T(0)), T(1)};
    const T square = max(dot(l, l), T(1e-300));
    for (int round = 0; round < kRounds; ++round) {
        const Vector3<T> w = inverse_inertia.cwiseProduct(l);
        const Vector3<T> across = cross(l, w);
        const T slope = dot(across, across) / square;  // of half the work, squared
        const T lack = (work - dot(l, w)) * T(0.5);
        const T share = lack / max(slope + T(kFlat) * dot(w, w), T(1e-300));
        Vector3<T> theta = across * (-share / square);
        const T size = dot(theta, theta);
        theta = theta * select_greater(size, T(0.01), T(0.1) / sqrt(max(size, T(0.01))), T(1));
        const UnitQuaternion<T> turn = unit_exponential<T>(theta);
        l = turn.inverse() * l;
        whole = whole * turn;
    }
    return whole;
}

/// The turn of a free body over h in its own frame: its momentum is constant in space, and its
/// energy is what it was, however coarse the parts. `l` is L in the body's frame [kg m²/s] before
/// it, then after it.
template <class T>
inline UnitQuaternion<T> free_turn(Vector3<T>& l, const Vector3<T>& inverse_inertia, const T& h) {
    const T work = dot(l, Vector3<T>(inverse_inertia.cwiseProduct(l)));
    const UnitQuaternion<T> turn =
        turn_in_parts<T>(l, inverse_inertia, h, part_count<T>(l, inverse_inertia, h));
    return turn * energy_correction<T>(l, inverse_inertia, work);
}

}  // namespace plumb
