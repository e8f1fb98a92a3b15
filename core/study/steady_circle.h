// SPDX-License-Identifier: MIT
/// A disk that rolls in a circle.
#pragma once

#include "math/types.h"

#include <cmath>

namespace plumb::study {

/// A disk that rolls in a circle at a steady tilt θ of its axis from upright, going round at Ω.
///
/// Axes that go round with it: e₃ along the disk's axis, e₂ up its slope, e₁ = e₂ × e₃ level. With
/// w the rate about e₃, ω = Ω sin θ e₂ + w e₃ and L = A Ω sin θ e₂ + C w e₃. The disk touches at
/// −(r e₂ + b e₃), b half its height, so that its centre moves by v e₁, v = b Ω sin θ − r w, and is
/// accelerated by Ω v (cos θ e₂ − sin θ e₃). With the ground's force F, of
/// F₂ = m (Ω v cos θ + g sin θ) and F₃ = m (g cos θ − Ω v sin θ), the torque about the centre is
/// (b F₂ − r F₃) e₁, and the change of L is Ω × L = (C w Ω sin θ − A Ω² sin θ cos θ) e₁. Both are
/// equal: an equation for w. For a thin disk it is
/// ¼ r Ω² sin θ cos θ − (3/2) r w Ω sin θ = g cos θ.
struct SteadyCircle {
    double radius, half_height;  ///< [m]
    double tilt;                 ///< [rad]
    double round;                ///< [rad/s]
    double gravity = 9.81;       ///< [m/s²]

    /// w [rad/s].
    double rate_about_axis() const {
        const double s = std::sin(tilt), c = std::cos(tilt), r = radius, b = half_height;
        const double inertia_a = r * r / 4 + b * b / 3, inertia_c = r * r / 2;
        // (b F₂ − r F₃) − (C w Ω s − A Ω² s c) = rest + w · slope
        const double v_rest = b * round * s, v_slope = -r;
        const double rest = b * (round * v_rest * c + gravity * s) -
                            r * (gravity * c - round * v_rest * s) +
                            inertia_a * round * round * s * c;
        const double slope = round * v_slope * (b * c + r * s) - inertia_c * round * s;
        return -rest / slope;
    }

    /// ω is Ω about upright and this about the axis, w less Ω's share of it [rad/s].
    double rate_beside_round() const { return rate_about_axis() - round * std::cos(tilt); }
};

}  // namespace plumb::study
