// SPDX-License-Identifier: MIT
/// What acts along or about a joint's free axis, as a row that drive.h solves: limit, motor, spring
/// and damper, dry friction, greatest speed.
///
///   q  coordinate now [m], [rad]     rate  its speed at the end of the substep
///   k  stiffness [N/m], [N m/rad]    d     damping [N s/m], [N m s/rad]
#pragma once

#include "scene/joint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

struct DriveRow {
    double bias = 0, softness = 0;
    double lowest = 0, highest = 0;  ///< [N s], [N m s]
};

/// A spring that is at ease at `rest`, which itself moves at `speed`, taken at the end of the
/// substep: λ = −h [k (q + h rate − rest) + d (rate − speed)].
inline DriveRow spring_row(double q, double rest, double speed, double k, double d, double h) {
    constexpr double any = std::numeric_limits<double>::infinity();
    const double stiff = d + h * k;
    if (!(stiff > 0)) return {};
    return {(k * (q - rest) - d * speed) / stiff, 1 / (h * stiff), -any, any};
}

/// The nearer of two limits: it may be reached in this substep and no more; what is beyond it goes
/// by the share s, at no more than `recovery` [m/s], [rad/s].
inline DriveRow limit_row(double q, double lower, double upper, double s, double recovery,
                          double h) {
    constexpr double any = std::numeric_limits<double>::infinity();
    const auto closing = [&](double gap) {  // speed towards the limit that is left
        return gap >= 0 ? gap / h : -std::min(-gap * s / h, recovery);
    };
    if (lower == upper)
        return {q >= lower ? -closing(lower - q) : closing(q - lower), 0, -any, any};
    if (q - lower < upper - q) return {closing(q - lower), 0, 0, any};
    return {-closing(upper - q), 0, -any, 0};
}

/// Holds a speed with at most the motor's force.
inline DriveRow velocity_motor_row(double speed, double greatest, double h) {
    return {-speed, 0, -greatest * h, greatest * h};
}

/// Goes to a place as a damped oscillator of the given frequency would: k = m ω², d = 2 ζ m ω, with
/// m the mass that the row feels [kg], [kg m²].
inline DriveRow position_motor_row(double q, double place, double speed, const JointMotor& motor,
                                   double mass, double h) {
    constexpr double kTurn = 6.283185307179586;
    const double omega = kTurn * motor.frequency;
    DriveRow row = spring_row(q, place, speed, mass * omega * omega,
                              2 * motor.damping_ratio * mass * omega, h);
    row.lowest = -motor.greatest * h, row.highest = motor.greatest * h;
    return row;
}

/// Stands still with at most the given force.
inline DriveRow friction_row(double greatest, double h) {
    return {0, 0, -greatest * h, greatest * h};
}

/// Keeps a speed, now `rate`, within `greatest` to the side to which it goes.
inline DriveRow speed_row(double rate, double greatest) {
    constexpr double any = std::numeric_limits<double>::infinity();
    if (rate < 0) return {greatest, 0, 0, any};
    return {-greatest, 0, -any, 0};
}

/// A target and how fast it moves.
struct MotorTarget {
    double value = 0, speed = 0;
};

/// Linear between keys, held before the first and after the last.
inline MotorTarget motor_target(const JointMotor& motor, double time) {
    const auto& keys = motor.keys;
    if (keys.empty()) return {motor.target, 0};
    const auto next = std::upper_bound(keys.begin(), keys.end(), time,
                                       [](double t, const ValueKey& key) { return t < key.time; });
    if (next == keys.begin()) return {keys.front().value, 0};
    if (next == keys.end()) return {keys.back().value, 0};
    const ValueKey& before = *(next - 1);
    const double speed = (next->value - before.value) / (next->time - before.time);
    return {before.value + speed * (time - before.time), speed};
}

}  // namespace plumb
