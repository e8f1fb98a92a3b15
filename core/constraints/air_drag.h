// SPDX-License-Identifier: MIT
/// Drag of the air on a surface, by the cross-flow principle (Hoerner 1965, Fluid-Dynamic Drag,
/// chapters 2 and 3): the air's velocity across a plate makes the drag of pressure, its velocity
/// along the plate the drag of friction on each side.
///
///   w  velocity of the air relative to the surface, w = wₙ n + w_t [m/s]
///   n  unit normal, A area [m²], ρ density of the air [kg/m³]
///   f  force on the surface [N]: f = ½ ρ A (c |wₙ| wₙ n + 2 c_f |w_t| w_t)
///
/// A sheet has air on both sides, a closed surface on one: it has half of the force, so that a cube
/// across the wind has the c of a plate between its front and its back. As w points from the
/// surface to the air, f = R w with a matrix R that is nowhere negative.
#pragma once

#include "math/types.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace plumb {

/// What the force is told by, of one surface [kg/m³].
struct AirCoefficients {
    double pressure = 0, friction = 0;  ///< ½ ρ c and ρ c_f, half of them where it is closed
};
inline AirCoefficients air_coefficients(double density, double drag, double skin_drag,
                                        bool is_closed) {
    const double sides = is_closed ? 1 : 2;
    return {0.25 * sides * density * drag, 0.5 * sides * density * skin_drag};
}

/// R of a piece of a surface: `area` is A n [N s/m].
inline Matrix3d air_resistance(const AirCoefficients& c, const Vector3d& area, const Vector3d& w) {
    const double size = area.norm();
    if (!(size > 0)) return Matrix3d::Zero();
    const Vector3d n = area / size;
    const double across = w.dot(n), along = (w - across * n).norm();
    const Matrix3d normal = n * n.transpose();
    return size * (c.pressure * std::abs(across) * normal +
                   c.friction * along * (Matrix3d::Identity() - normal));
}

/// w after a time h in which the air drags at a mass m with R at w: implicit Euler, with R made
/// smaller by the share s of w that is left where R is as large in all directions as along w,
/// s (1 + s κ) = 1. Exact along a normal, and |w| never grows, however long h is.
inline Vector3d dragged(const Vector3d& w, const Matrix3d& resistance, double mass, double h) {
    const double square = w.squaredNorm();
    if (!(square > 0)) return w;
    const double k = h * w.dot(resistance * w) / (mass * square);
    const double s = 2 / (1 + std::sqrt(1 + 4 * k));
    const Matrix3d system = mass * Matrix3d::Identity() + h * s * resistance;
    return system.llt().solve(mass * w);
}

}  // namespace plumb
