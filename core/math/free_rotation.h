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

/// 1 where a turn in one step is too far to be made at one rate, else 0: beyond, a gyroscope on a
/// joint begins to nod.
template <class T>
inline T turns_too_far(const Vector3<T>& rate, const T& h) {
    constexpr double kTooFar = 0.5;  // [rad]
    return select_greater(dot(rate, rate) * (h * h), T(kTooFar * kTooFar), T(1), T(0));
}

/// ω in the body's frame; `momentum`: L there [kg m²/s]; `inertia`: principal moments [kg m²].
/// Lanes that have converged stay as they are, so that each has the bits of a number alone. Where
/// a body turns too far for that, ω stays.
template <class T>
inline Vector3<T> middle_rate(const Vector3<T>& momentum, const Vector3<T>& inertia,
                              const Vector3<T>& inverse_inertia, const T& h) {
    constexpr int kMostRounds = 12;
    const Vector3<T> start = inverse_inertia.cwiseProduct(momentum);
    const Vector3<T> turned = momentum + cross(momentum, start) * (h * T(0.5));  // to first order
    Vector3<T> rate = inverse_inertia.cwiseProduct(turned);
    const Vector3<T> guessed = rate - start;
    T moving = T(1), before = dot(guessed, guessed);
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

/// A free body's energy in three parts: ½ (m L² + Σ δₖ lₖ²), with m the middle one of the inverse
/// moments 1/Iₖ, δ = 1/I − m, and l the momentum L seen from the body. Each by itself is a turn
/// that is known: about L at m L, and about the principal axes with the least and the greatest
/// inverse moment at δₖ lₖ; the first goes with both others.
template <class T>
struct EnergyParts {
    T middle, slow, fast;  ///< m, |δ| of the least and of the greatest 1/I [1/(kg m²)]
    Vector3<T> about_slow, about_fast;  ///< δ, but for one axis 0

    explicit EnergyParts(const Vector3<T>& i) {
        const T least = min(i[0], min(i[1], i[2])), greatest = max(i[0], max(i[1], i[2]));
        middle = max(min(i[0], i[1]), min(max(i[0], i[1]), i[2]));
        slow = middle - least;
        fast = greatest - middle;
        for (int k = 0; k < 3; ++k) {
            about_slow[k] = min(i[k] - middle, T(0));
            about_fast[k] = max(i[k] - middle, T(0));
        }
    }
};

/// Parts in which a free body is turned over h, so that none turns by more than kPart about an axis
/// of its own, from the fastest that momentum and energy allow; 1 where two moments are equal, for
/// such a body's turn is known. At most kMostParts: what is faster turns in longer parts, momentum
/// and energy kept.
template <class T>
inline T part_count(const Vector3<T>& l, const EnergyParts<T>& energy, const T& work, const T& h) {
    constexpr double kPart = 0.4;  // [rad]
    constexpr double kMostParts = 400, kEqual = 1e-9;
    constexpr double kWhole = 6755399441055744.0;  // 1.5 · 2⁵²: a sum with it has no fraction
    const T square = dot(l, l);
    const T above = max(work - (energy.middle - energy.slow) * square, T(0)),
            below = max((energy.middle + energy.fast) * square - work, T(0));
    const T about_fast = sqrt(energy.fast * min(energy.fast * square, above)),
            about_slow = sqrt(energy.slow * min(energy.slow * square, below));
    const T angle = h * max(about_fast, about_slow), other = h * min(about_fast, about_slow);
    const T wanted = select_greater(other, T(kEqual), angle * T(1 / kPart) + T(0.5), T(1));
    return max((min(wanted, T(kMostParts)) + T(kWhole)) - T(kWhole), T(1));
}

/// The turn of a free body over h in its own frame, so that R₁ = R₀ · turn, by `parts` steps of
/// fourth order, each made of turns about two axes in alternation: the splitting S₆ of Blanes and
/// Moan (2002). `l` is L seen from the body at the start, then at the end.
///
/// A needle needs that: its energy hangs on the small part of L that lies along it, and only turns
/// about the body's own axes leave that alone as they should.
template <class T>
inline UnitQuaternion<T> turn_in_parts(Vector3<T>& l, const EnergyParts<T>& energy, const T& h,
                                       const T& parts) {
    constexpr double a1 = 0.0792036964311957, a2 = 0.353172906049774, a3 = -0.0420650803577195,
                     a4 = 1 - 2 * (a1 + a2 + a3), b1 = 0.209515106613362, b2 = -0.143851773179818,
                     b3 = 0.5 - (b1 + b2);
    constexpr double kTurns[13] = {a1, b1, a2, b2, a3, b3, a4, b3, a3, b2, a2, b1, a1};
    const T part = h / parts;
    UnitQuaternion<T> whole = unit_exponential<T>(Vector3<T>(l * (energy.middle * h)));
    for (T done = T(0.5); any_greater(parts, done); done = done + T(1)) {
        const T time = select_greater(parts, done, part, T(0));
        for (int k = 0; k < 13; ++k) {
            const Vector3<T>& about = k % 2 == 0 ? energy.about_fast : energy.about_slow;
            const UnitQuaternion<T> turn =
                unit_exponential<T>(Vector3<T>(about.cwiseProduct(l) * (time * T(kTurns[k]))));
            l = turn.inverse() * l;
            whole = whole * turn;
        }
    }
    return whole.normalized();
}

/// A small turn, in the body's frame, after which L seen from there has w·L = `work` again [J]: up
/// or down the slope of the energy on the sphere |L| = const. `l` is L before, then after it.
///
/// By an angle ϑ energy changes by g ϑ and at most ½ c ϑ²: the angle is a root of both, for
/// Newton's would be too wide near the middle axis, where the slope g goes through 0. About an axis
/// itself there is next to nothing to correct, and a least slope keeps rounding from being divided
/// by it.
template <class T>
inline UnitQuaternion<T> energy_correction(Vector3<T>& l, const Vector3<T>& inverse_inertia,
                                           const EnergyParts<T>& energy, const T& work) {
    constexpr int kRounds = 4;
    constexpr double kFlat = 1e-14;  // of |w| |L|, squared
    const T square = dot(l, l), curvature = (energy.slow + energy.fast) * square;
    UnitQuaternion<T> whole{Vector3<T>(T(0), T(0), T(0)), T(1)};
    for (int round = 0; round < kRounds; ++round) {
        const Vector3<T> w = inverse_inertia.cwiseProduct(l), across = cross(l, w);
        const T lack = (work - dot(l, w)) * T(0.5);
        const T flat = dot(across, across) + T(kFlat) * (dot(w, w) * square);
        const T slope = sqrt(max(flat, T(1e-290)));
        const T both = slope + sqrt(slope * slope + T(2) * curvature * max(lack, -lack));
        const UnitQuaternion<T> turn =
            unit_exponential<T>(Vector3<T>(across * (T(-2) * lack / (slope * both))));
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
    const EnergyParts<T> energy(inverse_inertia);
    const UnitQuaternion<T> turn =
        turn_in_parts<T>(l, energy, h, part_count<T>(l, energy, work, h));
    return turn * energy_correction<T>(l, inverse_inertia, energy, work);
}

}  // namespace plumb
