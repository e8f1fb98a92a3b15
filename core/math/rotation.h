// SPDX-License-Identifier: MIT
/// Rotations by the exponential map (§4): a vector ϑ turns by |ϑ| about ϑ/|ϑ|.
#pragma once

#include "math/types.h"

#include <cmath>

namespace plumb {

/// Sine and cosine of an angle of at least 0 [rad], in additions and products alone: a system's own
/// differ in the last bit from processor to processor, and with it every run.
struct SineCosine {
    double sine, cosine;
};
inline SineCosine sine_cosine(double angle) {
    constexpr double kTurn = 6.283185307179586;
    double x = angle < 16 ? angle : std::fmod(angle, kTurn);
    int halvings = 0;
    for (; x > 0.25; x *= 0.5) ++halvings;
    const double y = x * x;
    double sine = 1, cosine = 1;
#pragma GCC unroll 6
    for (int k = 6; k >= 1; --k) {
        sine = 1 - y * (1.0 / ((2 * k) * (2 * k + 1))) * sine;
        cosine = 1 - y * (1.0 / ((2 * k - 1) * (2 * k))) * cosine;
    }
    sine *= x;
    for (; halvings > 0; --halvings) {
        const double doubled = 2 * sine * cosine;
        cosine = 1 - 2 * sine * sine;
        sine = doubled;
    }
    return {sine, cosine};
}

/// The angle in [0, π/2] of a sine and a cosine of at least 0 [rad], likewise.
inline double angle_of(double sine, double cosine) {
    double tangent = sine / (std::sqrt(sine * sine + cosine * cosine) + cosine);
    for (int k = 0; k < 3; ++k) tangent /= 1 + std::sqrt(1 + tangent * tangent);
    const double y = tangent * tangent;
    double series = 0;
    for (int k = 8; k >= 0; --k) series = 1.0 / (2 * k + 1) - y * series;
    return 16 * tangent * series;
}

/// exp(ϑ) as a unit quaternion. ϑ [rad]
inline Quaterniond exponential_map(const Vector3d& theta) {
    const double half = 0.5 * theta.norm();
    const SineCosine turn = sine_cosine(half);
    // sin(x)/x by its series where the quotient loses digits
    const double s = half < 1e-4 ? 0.5 * (1 - half * half / 6) : 0.5 * turn.sine / half;
    return {turn.cosine, s * theta.x(), s * theta.y(), s * theta.z()};
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
/// Good to 1e-7 of |r| in single and to 1e-13 in double precision while |ϑ| ≤ 1.5 rad, a step's
/// turn.
template <class T>
class Turn {
public:
    explicit Turn(const Vector3<T>& theta) : theta_(theta), sine_(T(1)), cosine_(T(0.5)) {
        const T x = dot(theta, theta);
        T term_sine = T(1), term_cosine = T(0.5);
        for (int k = 1; k <= 9; ++k) {
            term_sine = -term_sine * x * T(1.0 / ((2 * k) * (2 * k + 1)));
            term_cosine = -term_cosine * x * T(1.0 / ((2 * k + 1) * (2 * k + 2)));
            sine_ = sine_ + term_sine;
            cosine_ = cosine_ + term_cosine;
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
    Vector3<T> theta_;
    T sine_, cosine_;
};

}  // namespace plumb
