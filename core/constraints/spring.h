// SPDX-License-Identifier: MIT
/// How a spring and a damper act over a substep of length h.
///
/// x is the elongation at the start, v the rate at which it changed before and v′ that at which it
/// changes now; z = h² k/m and y = h d/m with m the mass that the spring moves:
///
///   λ = −h k [x + θ h v′ − β h v] − h d [(1 − σ) v′ + σ v]
///
/// θ = 1, β = σ = 0 is implicit Euler: stable, but swings die away by z in each substep. θ = β
/// keeps their energy: it is leapfrog on a spring of stiffness k/(1 + θ z), which is stable at any
/// z where θ ≥ 1/4 (Newmark's average acceleration) and has the period to fourth order at θ = 1/12
/// (Störmer and Cowell; Hairer, Lubich, Wanner, Geometric Numerical Integration, I.1.4). σ = 1/2 is
/// the trapezoidal rule. What swings faster than substeps can follow shall die away, as a rigid
/// joint does that stiff springs stand for; so θ and β go over to implicit Euler where the z of all
/// springs at a body come to 1 to 4, and σ where their y do.
#pragma once

#include <algorithm>
#include <cstdint>

namespace plumb {

/// How long a substep is [s], for what part of it forces push: 1, or a half in the very first of a
/// leapfrog start; and when it begins [s].
struct SubstepTime {
    double h, part = 1, start = 0;

    double end() const { return start + h; }
    double push() const { return part * h; }  ///< for how long forces push [s]
};

/// θ and β, divided by the part, and σ.
struct SpringShares {
    double ahead = 1, back = 0, damper_back = 0;
};

/// Of a spring with z, and of a damper with y, both at least 0; infinite where nothing can move.
/// `crowd`: springs that act on one of its bodies, at the most; together they swing by the sum of
/// their z. In the first substep of a leapfrog start rates change by half as much as from one
/// substep to the next; and half a push of the force that is met at h/3 gives the first
/// displacement to third order, x₀ + h v + h²/2 f(x₀ + h v/3).
inline SpringShares spring_shares(double z, double y, double part, std::uint32_t crowd) {
    const auto follows = [](double x) { return std::clamp((4 - x) / 3, 0.0, 1.0); };
    const double kept = 1.0 / 12 + std::min(z * z, 1.0) / 6, share = follows(crowd * z);
    const double ahead = 1 - share * (1 - kept), back = share * kept;
    return {ahead / part, back / part - share * (1 - part) * 2 / 3, 0.5 * follows(crowd * y)};
}

}  // namespace plumb
