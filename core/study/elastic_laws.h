// SPDX-License-Identifier: MIT
/// Where elastic sheets and beams come to rest, and how fast they swing, by formulas.
///
///   E, ν  modulus [Pa], Poisson's ratio    A, I  section [m²] and its second moment [m⁴]
///   t     thickness [m]                    ρ     density [kg/m³]
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace plumb::study {

/// Stretch λ of a sheet whose energy is that of Green's strain: N = E A (λ² − 1) λ/2. `force`: of
/// E A.
inline double green_stretch(double force) {
    double stretch = 1 + force;
    for (int i = 0; i < 10; ++i)
        stretch -=
            ((stretch * stretch - 1) * stretch / 2 - force) / ((3 * stretch * stretch - 1) / 2);
    return stretch;
}

/// Elongation of a strip that hangs, over its length, in so many rows of which each carries what is
/// below its middle. `strain`: of the middle by Hooke's law, which is the elongation of what obeys
/// that, ρ g L / 2 E.
inline double hanging_elongation(std::uint32_t rows, double strain) {
    double sum = 0;
    for (std::uint32_t row = 1; row <= rows; ++row)
        sum += (green_stretch(2 * strain * (row - 0.5) / rows) - 1) / rows;
    return sum;
}

/// Pressure over that outside in a ball of skin that is blown up to λ times its radius R [Pa]:
/// Laplace's p = 2 N/r, in Green's strain p R = E t (λ − 1/λ) / (1 − ν).
inline double pressure_in_skin(double stretch, double radius, double stiffness, double nu) {
    return stiffness * (stretch - 1 / stretch) / ((1 - nu) * radius);
}

/// A beam of rectangular section that is held at one end.
struct Cantilever {
    double length = 1, height = 0.2, width = 0.2;  ///< [m]
    double young = 1e6, nu = 0.3, density = 1000;

    /// How far its tip hangs under its own weight [m], by Timoshenko: bending and shear,
    /// q L⁴/8EI + q L²/2κGA, with κ of a rectangle by Cowper.
    double deflection(double gravity) const {
        const double load = density * gravity * area();
        return load * std::pow(length, 4) / (8 * young * inertia()) +
               load * length * length / (2 * shear_stiffness());
    }
    /// The first bending frequency [Hz]: Euler and Bernoulli's (1.8751²/2π) √(EI/ρAL⁴), slowed
    /// down by shear and by the section's turning inertia, to first order in I/AL².
    double frequency() const {
        constexpr double kRoot = 1.875104068711961, kSlopes = 4.6478;  // L² ∫φ′² / ∫φ², its mode's
        const double slower = kSlopes *
                              (inertia() + young * inertia() * area() / shear_stiffness()) /
                              (area() * length * length);
        return kRoot * kRoot / (2 * std::numbers::pi * length * length) *
               std::sqrt(young * inertia() / (density * area() * (1 + slower)));
    }

private:
    double area() const { return height * width; }
    double inertia() const { return area() * height * height / 12; }
    double shear_stiffness() const {
        const double kappa = 10 * (1 + nu) / (12 + 11 * nu);
        return kappa * area() * young / (2 * (1 + nu));
    }
};

}  // namespace plumb::study
