// SPDX-License-Identifier: MIT
/// The air's velocity, everywhere the same.
///
/// Gusts swing along each axis with a period of its own, T, T/√2 and T/√3, so that they never come
/// again alike; they are a function of time alone, and 0 at the start.
#pragma once

#include "scene/settings.h"

#include <cmath>

namespace plumb {

/// At a time [s], where there is air [m/s].
inline Eigen::Vector3d wind_at(const Settings& s, double time) {
    constexpr double kTwoPi = 6.283185307179586;
    const double turn = kTwoPi * time / s.gust_period;
    const Eigen::Vector3d swing(std::sin(turn), std::sin(std::sqrt(2.0) * turn),
                                std::sin(std::sqrt(3.0) * turn));
    return *s.wind + s.gusts.cwiseProduct(swing);
}

}  // namespace plumb
