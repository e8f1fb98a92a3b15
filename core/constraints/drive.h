// SPDX-License-Identifier: MIT
/// A row along or about a joint's free axis:
///
///   rate + bias + softness λ = 0,   lowest ≤ λ ≤ highest
///
/// for the summed impulse λ of the substep, solved as Eq. 6 solves any row. What bias, softness and
/// bounds are for limits, motors, springs and friction: drive_rows.h.
#pragma once

#include "math/lanes.h"

namespace plumb {

/// Adds an impulse to λ, keeps the sum within the row's bounds, and returns what was added. `mass`
/// is 1 / (K + softness).
template <class T>
inline T drive(T& lambda, const T& rate, const T& bias, const T& softness, const T& mass,
               const T& lowest, const T& highest) {
    const T before = lambda;
    lambda = min(max(before - mass * (rate + bias + softness * before), lowest), highest);
    return lambda - before;
}

}  // namespace plumb
