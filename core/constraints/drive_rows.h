// SPDX-License-Identifier: MIT
/// What acts along or about a joint's free axis, as a row that drive.h solves: limit, motor, spring
/// and damper, dry friction, greatest speed.
///
///   q  coordinate now [m], [rad]     rate  its speed at the end of the substep
///   k  stiffness [N/m], [N m/rad]    d     damping [N s/m], [N m s/rad]
#pragma once

#include "constraints/spring.h"
#include "scene/joint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

struct DriveRow {
    double bias = 0, softness = 0;
    double lowest = 0, highest = 0;  ///< [N s], [N m s]
};

/// An axis at the start of a substep.
struct AxisMotion {
    double q, rate;           ///< now [m], [rad]; before forces act [m/s], [rad/s]
    double mass;              ///< that the row feels [kg], [kg m²]; 0 where nothing can move
    std::uint32_t crowd = 1;  ///< springs on one of its bodies, at the most
};

/// A spring that at the end of the substep is at ease at `rest`, which itself moves at `speed`.
inline DriveRow spring_row(const AxisMotion& axis, double rest, double speed, double k, double d,
                           const SubstepTime& time) {
    constexpr double any = std::numeric_limits<double>::infinity();
    const double h = time.h, part = time.part;
    const auto per_mass = [&](double x) { return axis.mass > 0 ? x / axis.mass : any; };
    const SpringShares share =
        spring_shares(per_mass(h * h * k), per_mass(h * d), part, axis.crowd);
    const double slope = share.ahead * h * k + (1 - share.damper_back) * d;
    if (!(slope > 0)) return {};
    const double x = axis.q - (rest - h * speed), before = axis.rate - speed;
    const double offset = k * (x - share.back * h * before) + share.damper_back * d * before;
    return {offset / slope - speed, 1 / (part * h * slope), -any, any};
}

/// The limit that is nearer to where q goes at its rate: it may be reached in this substep and no
/// more; what is beyond it goes by the share s, at no more than `recovery` [m/s], [rad/s].
inline DriveRow limit_row(double q, double rate, double lower, double upper, double s,
                          double recovery, double h) {
    constexpr double any = std::numeric_limits<double>::infinity();
    const auto closing = [&](double gap) {  // speed towards the limit that is left
        return gap >= 0 ? gap / h : -std::min(-gap * s / h, recovery);
    };
    if (lower == upper)
        return {q >= lower ? -closing(lower - q) : closing(q - lower), 0, -any, any};
    const double next = std::clamp(q, lower, upper) + h * rate;
    if (next - lower < upper - next) return {closing(q - lower), 0, 0, any};
    return {-closing(upper - q), 0, -any, 0};
}

/// Holds a speed with at most the motor's force.
inline DriveRow velocity_motor_row(double speed, double greatest, const SubstepTime& time) {
    const double most = greatest * time.push();
    return {-speed, 0, -most, most};
}

/// Goes to a place as a damped oscillator of the given frequency would: k = m ω², d = 2 ζ m ω, with
/// m the mass that the row feels.
inline DriveRow position_motor_row(const AxisMotion& axis, double place, double speed,
                                   const JointMotor& motor, const SubstepTime& time) {
    constexpr double kTurn = 6.283185307179586;
    const double omega = kTurn * motor.frequency;
    DriveRow row = spring_row(axis, place, speed, axis.mass * omega * omega,
                              2 * motor.damping_ratio * axis.mass * omega, time);
    row.highest = motor.greatest * time.push(), row.lowest = -row.highest;
    return row;
}

/// Stands still with at most the given force.
inline DriveRow friction_row(double greatest, const SubstepTime& time) {
    const double most = greatest * time.push();
    return {0, 0, -most, most};
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
