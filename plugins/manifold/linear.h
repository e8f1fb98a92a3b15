// SPDX-License-Identifier: MIT
/// Three-vectors and rigid frames for the collision plugins: a few lines of plain arithmetic, so
/// that a plugin needs nothing but the standard library beside its back-end.
#pragma once

#include <plumb/shape.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 operator*(Vec3 a, double s) { return s * a; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
inline bool finite(Vec3 a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// The i-th component, i in 0…2.
inline double& at(Vec3& a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }
inline double at(const Vec3& a, int i) { return i == 0 ? a.x : i == 1 ? a.y : a.z; }

/// `a` made unit; `otherwise` where it is too short to have a direction.
inline Vec3 unit_or(Vec3 a, Vec3 otherwise) {
    const double length = norm(a);
    return length > 1e-12 ? (1 / length) * a : otherwise;
}

/// Some unit vector at a right angle to the unit vector `a`.
inline Vec3 any_perpendicular(Vec3 a) {
    const Vec3 axis = std::abs(a.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return unit_or(cross(a, axis), {0, 0, 1});
}

/// A rigid frame: its three unit axes and its origin, in the outer frame.
struct Frame {
    Vec3 axis[3];
    Vec3 origin;  ///< [m]
};

inline Vec3 rotated(const Frame& f, Vec3 v) {
    return v.x * f.axis[0] + v.y * f.axis[1] + v.z * f.axis[2];
}
inline Vec3 to_outer(const Frame& f, Vec3 point) { return rotated(f, point) + f.origin; }
inline Vec3 turned_back(const Frame& f, Vec3 v) {
    return {dot(f.axis[0], v), dot(f.axis[1], v), dot(f.axis[2], v)};
}
inline Vec3 to_inner(const Frame& f, Vec3 point) { return turned_back(f, point - f.origin); }

inline Frame operator*(const Frame& outer, const Frame& inner) {
    return {{rotated(outer, inner.axis[0]), rotated(outer, inner.axis[1]),
             rotated(outer, inner.axis[2])},
            to_outer(outer, inner.origin)};
}

/// The frame of a pose; the quaternion is made unit first. All axes are NaN where that cannot be
/// done.
Frame frame_of(const Pose& pose);

/// Rotation of a frame as a unit quaternion.
Quat quaternion_of(const Frame& frame);

}  // namespace plumb
