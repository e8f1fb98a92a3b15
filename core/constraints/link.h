// SPDX-License-Identifier: MIT
/// Distance between any two points (§5, §7): C = |a − b| − L, or its excess over a longest and its
/// want of a shortest length; and two points at one place, C = a − b.
///
/// The impulse acts along the line on which the points are at the start of the substep, which keeps
/// angular momentum and the energy of swings. A point that is pulled so hard that it would swing
/// more than a radian a substep is pulled along the line at the end instead, which is stable and
/// loses some of both.
#pragma once

#include "constraints/connector.h"

#include <algorithm>

namespace plumb {

/// A point at the start of the substep: of a body by its arm, or of a particle, which has neither
/// arm nor inertia.
struct LinkedPoint {
    Vector3d start = Vector3d::Zero();  ///< [m]
    Vector3d arm = Vector3d::Zero();    ///< from the body's centre of mass [m]
    InverseMass<double> inverse{0, {0, 0, 0, 0, 0, 0}};
};

/// How much of the line's turn in a substep the impulse follows, by z = h² ω² of a swing across it:
/// nothing up to a radian, all where the line of the start would be near its bound, 2 radians.
inline double line_share(double z) { return std::clamp((z - 1) / 2, 0.0, 1.0); }

/// The unit vector along which a link acts whose points are so far apart; any where they meet.
inline Vector3d line_of(const Vector3d& apart) {
    const double length = apart.norm();
    return length > 0 ? Vector3d(apart / length) : Vector3d(Vector3d::UnitY());
}

/// Response of both points to opposite impulses along the unit vector n [1/kg].
inline double line_response(const LinkedPoint& a, const LinkedPoint& b, const Vector3d& n) {
    return response(a.inverse, a.arm, n, n) + response(b.inverse, b.arm, n, n);
}

}  // namespace plumb
