// SPDX-License-Identifier: MIT
/// The lever at which a joint's impulse acts on a body: the arm of the substep's start, or turned
/// with the body.
///
/// At the start is what keeps momentum to rounding and energy for good, as SHAKE does: both bodies
/// feel the impulse at one point of the start's poses. But a load P/h on an arm r turns a body like
/// a pendulum of a = (h ω)² = h |P| |r| / I, and a force that stays where it was is an explicit
/// step of that pendulum: stable for a < 4 only.
///
/// A heavily loaded lever is therefore turned by what the body's turn changes,
///
///   ϑ = h (θ (ω₁ − ω₀) + κ (ω₁ − 2 ω₀ + ω₋₁)),   θ = 1/2, κ = −1/10
///
/// of the velocity ω₁ that is sought and those of the two substeps before. What swings slowly does
/// not feel it, since its velocity hardly changes: it loses |κ| a² / 2 of its amplitude a substep.
/// With θ alone the pendulum is a symplectic one of the frequency ω / √(1 + θ a), stable for every
/// load; κ takes what swings faster than substeps can follow down to 0.64 of itself each time. (The
/// characteristic polynomial is z (z − 1)² + a (z² + θ z (z − 1)² + κ (z − 1)³).)
///
/// An arm that swings far within a substep is another matter: rows at its start are poor rows for
/// its end. There the lever is that of the end, which loses some energy and angular momentum. So
/// are loaded levers of joints that are iterated: few iterations do not find the balance that would
/// keep the energy, and what they leave must not add any.
#pragma once

#include "constraints/connector.h"
#include "math/rotation.h"

namespace plumb {

template <class T>
struct JointLever {
    T share;         ///< of the substep's turn
    Vector3<T> lag;  ///< and what the turns of the past add [rad]

    /// ϑ, for the turn h ω₁ [rad].
    Vector3<T> angle(const Vector3<T>& turn) const { return turn * share + lag; }
};

/// What levers change of vectors that ride on a body; nothing is computed where none turns.
template <class T>
class LeverTurn {
public:
    LeverTurn(const JointLever<T>& lever, const Vector3<T>& turn)
        : turns_(any_greater(lever.share, T(0))) {
        if (turns_) turn_ = Turn<T>(lever.angle(turn));
    }

    Vector3<T> change(const Vector3<T>& r) const {
        return turns_ ? turn_.change(r) : Vector3<T>(T(0), T(0), T(0));
    }

private:
    bool turns_;
    Turn<T> turn_;
};

/// Arms at which a joint's impulse acts on a and b: they meet in the point of a as far as their
/// levers rest.
template <class T>
struct JointArms {
    Vector3<T> a, b;

    /// `r_a`, `r_b`: arms of the two points; `apart`: p_a − p_b, all three at the start of the
    /// substep; `opened`: by how much p_a − p_b has changed; `share_b`: of b's lever.
    JointArms(const LeverTurn<T>& lever_a, const LeverTurn<T>& lever_b, const T& share_b,
              const Vector3<T>& r_a, const Vector3<T>& r_b, const Vector3<T>& apart,
              const Vector3<T>& opened)
        : a(r_a + lever_a.change(r_a)), b(r_b + apart + lever_b.change(r_b) + opened * share_b) {}
};

template <class T>
inline T between_0_and_1(const T& x) {
    return min(max(x, T(0)), T(1));
}

/// Of a joint that is iterated; `a`: (h ω)², as above; `turn`: h ω₀ [rad].
template <class T>
inline JointLever<T> iterated_lever(const T& a, const Vector3<T>& turn) {
    const T far = max((a - T(0.05)) * T(4), (sqrt(dot(turn, turn)) - T(0.25)) * T(4));
    return {between_0_and_1<T>(far), Vector3<T>(T(0), T(0), T(0))};
}

/// The square of the angle by which a turn swings an arm [rad²]: none about the arm itself.
template <class T>
inline T swing_squared(const Vector3<T>& turn, const Vector3<T>& arm) {
    const Vector3<T> way = cross(turn, arm);
    return dot(way, way) / max(dot(arm, arm), T(1e-30));
}

/// Of a joint in a tree that is solved exactly; `swing`: see swing_squared; `turn`, `turn_before()`:
/// h ω₀ and h ω₋₁ [rad], the latter asked for only where a lever is loaded.
template <class T, class TurnBefore>
inline JointLever<T> exact_lever(const T& a, const T& swing, const Vector3<T>& turn,
                                 const TurnBefore& turn_before) {
    constexpr double kTheta = 0.5, kKappa = -0.1;
    constexpr double kFar = 0.2;  // [rad]
    T far = T(0);
    if (any_greater(swing, T(kFar * kFar)))
        far = between_0_and_1<T>((sqrt(swing) - T(kFar)) * T(10));
    const T near = (T(1) - far) * between_0_and_1<T>(a - T(1));
    if (!any_greater(near, T(0))) return {far, Vector3<T>(T(0), T(0), T(0))};
    return {far + near * T(kTheta + kKappa),
            (turn * T(-kTheta - 2 * kKappa) + turn_before() * T(kKappa)) * near};
}

/// (h ω)² of a body on a joint. `impulse`: of the substep before [N s]; `moment`: of its rotational
/// rows [N m s]; `arm`: of the joint [m]; `inverse_inertia`: world frame [1/(kg m²)].
template <class T>
inline T lever_load(const T& impulse, const T& moment, const Vector3<T>& arm,
                    const Symmetric3<T>& inverse_inertia, const T& h) {
    const T softest = inverse_inertia.xx + inverse_inertia.yy + inverse_inertia.zz;
    // the trace of [r]ᵀ I⁻¹ [r], over r
    const T square = dot(arm, arm);
    const T across = (softest * square - dot(arm, Vector3<T>(inverse_inertia * arm))) /
                     sqrt(max(square, T(1e-30)));
    return h * (impulse * across + moment * softest);
}

}  // namespace plumb
