// SPDX-License-Identifier: MIT
/// Two equal rods, one hung from the other's end: the double pendulum, integrated.
#pragma once

#include <array>

namespace plumb::study {

/// Angles of the rods from the vertical [rad], and how fast they change [rad/s].
struct RodAngles {
    std::array<double, 2> angle{}, rate{};
};

/// Each rod has the mass 1, for what it weighs does not matter.
struct TwoRods {
    double length = 1;         ///< [m]
    double inertia = 1. / 12;  ///< of a rod about its centre, over its mass [m²]
    double gravity = 9.81;     ///< [m/s²]

    /// The state after `time` more seconds, by Runge and Kutta's fourth order in steps of at most
    /// `step` [s].
    RodAngles advance(RodAngles state, double time, double step = 1e-4) const;

    /// Kinetic and potential, against the hook; constant in time [J].
    double energy(const RodAngles& state) const;

private:
    RodAngles change(const RodAngles& state) const;
};

}  // namespace plumb::study
