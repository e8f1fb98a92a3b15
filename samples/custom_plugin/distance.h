// SPDX-License-Identifier: MIT
/// How far a point is from a shape, in closed form and with a sign. A shape more is a case more.
#pragma once

#include <plumb/shape.h>

#include <algorithm>
#include <cmath>

namespace marbles {

using plumb::Shape;
using plumb::ShapeKind;
using plumb::Vec3;

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// What a shape says of a point, all in the shape's frame.
struct Nearest {
    Vec3 anchor;    ///< on the shape's core, or on its surface where that is sharp
    double radius;  ///< of the shape about its core [m]; 0 where it is sharp
    Vec3 normal;    ///< unit, out of the shape
};

/// From a point of a round shape's core; where they coincide any normal will do.
inline Nearest from_core(const Vec3& core, double radius, const Vec3& p, const Vec3& otherwise) {
    const double away = std::sqrt(dot(p - core, p - core));
    return {core, radius, away > 0 ? (1 / away) * (p - core) : otherwise};
}

inline Nearest from_box(const Vec3& h, const Vec3& p) {
    const Vec3 on{std::clamp(p.x, -h.x, h.x), std::clamp(p.y, -h.y, h.y),
                  std::clamp(p.z, -h.z, h.z)};
    const double away = std::sqrt(dot(p - on, p - on));
    if (away > 0) return {on, 0, (1 / away) * (p - on)};
    // Inside: out through the nearest face.
    const double depth[3] = {h.x - std::abs(p.x), h.y - std::abs(p.y), h.z - std::abs(p.z)};
    const auto axis = std::min_element(depth, depth + 3) - depth;
    if (axis == 0) return {{std::copysign(h.x, p.x), p.y, p.z}, 0, {std::copysign(1, p.x), 0, 0}};
    if (axis == 1) return {{p.x, std::copysign(h.y, p.y), p.z}, 0, {0, std::copysign(1, p.y), 0}};
    return {{p.x, p.y, std::copysign(h.z, p.z)}, 0, {0, 0, std::copysign(1, p.z)}};
}

inline Nearest nearest(const Shape& s, const Vec3& p) {
    switch (s.kind) {
        case ShapeKind::plane:
            return {{p.x, 0, p.z}, 0, {0, 1, 0}};
        case ShapeKind::box:
            return from_box(s.half_extents, p);
        case ShapeKind::capsule:
            return from_core({0, std::clamp(p.y, -s.half_height, s.half_height), 0}, s.radius, p,
                             {1, 0, 0});
        default:
            return from_core({0, 0, 0}, s.radius, p, {0, 1, 0});
    }
}

/// Whether all numbers that describe a shape make sense.
inline bool sound(const Shape& s) {
    const auto length = [](double x) { return std::isfinite(x) && x > 0; };
    if (s.kind == ShapeKind::box)
        return length(s.half_extents.x) && length(s.half_extents.y) && length(s.half_extents.z);
    if (s.kind == ShapeKind::capsule && !(std::isfinite(s.half_height) && s.half_height >= 0))
        return false;
    return s.kind == ShapeKind::plane || length(s.radius);
}

}  // namespace marbles
