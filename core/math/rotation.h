// SPDX-License-Identifier: MIT
/// Rotations by the exponential map (§4): a vector ϑ turns by |ϑ| about ϑ/|ϑ|.
#pragma once

#include "math/lanes.h"
#include "math/quaternion.h"

#include <cmath>

namespace plumb {

/// The angle in [0, π/2] of a sine and a cosine of at least 0 [rad], likewise.
inline double angle_of(double sine, double cosine) {
    double tangent = sine / (std::sqrt(sine * sine + cosine * cosine) + cosine);
    for (int k = 0; k < 3; ++k) tangent /= 1 + std::sqrt(1 + tangent * tangent);
    const double y = tangent * tangent;
    double series = 0;
    for (int k = 8; k >= 0; --k) series = 1.0 / (2 * k + 1) - y * series;
    return 16 * tangent * series;
}

/// ϑ, whose square is given, without the whole turns in it where that is more than `greatest`.
template <class T>
inline Vector3<T> without_whole_turns(const Vector3<T>& theta, const T& square, const T& greatest) {
    constexpr double kTurn = 6.283185307179586;
    // 1.5 · 2⁵² or 1.5 · 2²³: a sum with it has no fraction
    constexpr double kWhole =
        sizeof(ScalarOf<T>) == sizeof(float) ? 12582912.0 : 6755399441055744.0;
    const T angle = sqrt(square);
    const T turns = (angle * T(1 / kTurn) + T(kWhole)) - T(kWhole);
    const T shorter = (angle - turns * T(kTurn)) / max(angle, T(1));
    return theta * select_greater(square, greatest, shorter, T(1));
}

/// exp(ϑ) as a unit quaternion: cos x and ϑ/2 sin(x)/x for x = |ϑ|/2, from their series at x/8 by
/// doubling. There is no system's sine in it: that differs in the last bit from processor to
/// processor, and with it every run. ϑ [rad]
template <class T>
inline UnitQuaternion<T> unit_exponential(const Vector3<T>& theta) {
    constexpr double kGreatest = 39.5;  // about (2π)², where the series still have all digits
    constexpr int kHalvings = 3;
    T square = dot(theta, theta);
    Vector3<T> part = theta;
    if (any_greater(square, T(kGreatest))) {
        part = without_whole_turns<T>(theta, square, T(kGreatest));
        square = dot(part, part);
    }
    T y = square * T(1.0 / (4 << (2 * kHalvings)));
    T sine = T(1), cosine = T(1);  // sin(x)/x and cos x
#pragma GCC unroll 6
    for (int k = 6; k >= 1; --k) {
        sine = T(1) - y * T(1.0 / ((2 * k) * (2 * k + 1))) * sine;
        cosine = T(1) - y * T(1.0 / ((2 * k - 1) * (2 * k))) * cosine;
    }
    for (int i = 0; i < kHalvings; ++i) {
        const T versine = T(2) * y * sine * sine;
        sine = sine * cosine;
        cosine = T(1) - versine;
        y = T(4) * y;
    }
    return {part * (T(0.5) * sine), cosine};
}
inline Quaterniond exponential_map(const Vector3d& theta) {
    const UnitQuaternion<double> q = unit_exponential<double>(theta);
    return {q.w, q.v.x(), q.v.y(), q.v.z()};
}

/// log(q): the rotation vector of the shorter way round [rad].
inline Vector3d rotation_vector(const Quaterniond& q) {
    const double sign = q.w() < 0 ? -1 : 1;
    const double sine = q.vec().norm();
    const double scale = sine < 1e-9 ? 2 : 2 * angle_of(sine, sign * q.w()) / sine;
    return scale * sign * q.vec();
}

/// exp(ϑ) q, normalised.
inline Quaterniond turned(const Quaterniond& q, const Vector3d& theta) {
    return (exponential_map(theta) * q).normalized();
}

/// exp(ϑ) − 1 over any number type, by Rodrigues' formula with the series of sin(x)/x and (1 − cos
/// x)/x².
///
/// Good to 1e-7 of |r| in single and to 1e-13 in double precision. Beyond 1.5 rad, more than what
/// is resolved turns in a substep, it is that of exp(ϑ) as a quaternion: the series would grow
/// without bound.
template <class T>
class Turn {
public:
    /// By nothing.
    Turn() : theta_(T(0), T(0), T(0)), sine_(T(1)), cosine_(T(0.5)) {}

    explicit Turn(const Vector3<T>& theta) : theta_(theta), sine_(T(1)), cosine_(T(0.5)) {
        const T x = dot(theta, theta);
        T term_sine = T(1), term_cosine = T(0.5);
        for (int k = 1; k <= kTerms; ++k) {
            term_sine = -term_sine * x * T(1.0 / ((2 * k) * (2 * k + 1)));
            term_cosine = -term_cosine * x * T(1.0 / ((2 * k + 1) * (2 * k + 2)));
            sine_ = sine_ + term_sine;
            cosine_ = cosine_ + term_cosine;
        }
        if (any_greater(x, T(kGreatest))) {
            const UnitQuaternion<T> q = unit_exponential<T>(theta);
            for (int k = 0; k < 3; ++k)
                theta_[k] = select_greater(x, T(kGreatest), q.v[k], theta_[k]);
            sine_ = select_greater(x, T(kGreatest), T(T(2) * q.w), sine_);
            cosine_ = select_greater(x, T(kGreatest), T(2), cosine_);
        }
    }

    /// exp(ϑ) r − r.
    Vector3<T> change(const Vector3<T>& r) const {
        const Vector3<T> once = cross(theta_, r);
        return once * sine_ + cross(theta_, once) * cosine_;
    }
    /// exp(ϑ) r.
    Vector3<T> operator()(const Vector3<T>& r) const { return r + change(r); }

private:
    static constexpr double kGreatest = 2.25;  ///< of |ϑ|², where the series are good [rad²]
    static constexpr int kTerms = sizeof(ScalarOf<T>) == sizeof(float) ? 5 : 9;

    Vector3<T> theta_;  ///< or the quaternion's vector
    T sine_, cosine_;
};

}  // namespace plumb
