// SPDX-License-Identifier: MIT
#include "geometry/shape_support.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Farthest vertex along d [m].
double vertex_support(const Shape& s, const Vector3d& d) {
    double farthest = -kInfinite;
    for (std::uint32_t i = 0; i < s.vertex_count; ++i)
        farthest = std::max(farthest, to_eigen(s.vertices[i]).dot(d));
    return farthest;
}

/// Farthest point of a shape along the unit vector d, both in its own frame [m].
double local_support(const Shape& s, const Vector3d& d) {
    const double across = std::hypot(d.x(), d.z());
    switch (s.kind) {
        case ShapeKind::plane:
            return d.y() > 1 - 1e-12 ? 0 : kInfinite;
        case ShapeKind::sphere:
            return s.radius;
        case ShapeKind::box:
            return to_eigen(s.half_extents).dot(d.cwiseAbs());
        case ShapeKind::capsule:
            return s.radius + s.half_height * std::abs(d.y());
        case ShapeKind::cylinder:
            return s.radius * across + s.half_height * std::abs(d.y());
        case ShapeKind::cone:
            return std::max(s.half_height * d.y(), s.radius * across - s.half_height * d.y());
        case ShapeKind::hull:
        case ShapeKind::mesh:
            return vertex_support(s, d);
        case ShapeKind::height_field:
        case ShapeKind::compound:
            break;
    }
    return kInfinite;
}

double height_field_extent(const Shape& s) {
    const auto count = static_cast<std::size_t>(s.rows) * s.columns;
    const auto [low, high] = std::minmax_element(s.heights, s.heights + count);
    const double height = count > 0 ? *high - *low : 0;
    return std::max({height, s.spacing_x * (s.columns - 1.0), s.spacing_z * (s.rows - 1.0)});
}

/// The box about a shape in an outer frame, as supports along its axes; infinite for a plane.
double compound_extent(const Shape& s) {
    Vector3d low = Vector3d::Constant(kInfinite), high = -low;
    for (std::uint32_t i = 0; i < s.part_count; ++i) {
        const ShapePart& part = s.parts[i];
        const PlacedShape placed{&part.shape, to_eigen(part.local.position),
                                 to_eigen(part.local.rotation)};
        for (int k = 0; k < 3; ++k) {
            high[k] = std::max(high[k], support(placed, Vector3d::Unit(k)));
            low[k] = std::min(low[k], -support(placed, -Vector3d::Unit(k)));
        }
    }
    return (high - low).maxCoeff();
}

}  // namespace

PlacedShape placed_part(const Shape& shape, const Pose& local, const Pose& body,
                        std::uint32_t index) {
    const Quaterniond rotation = to_eigen(body.rotation);
    PlacedShape placed{&shape, to_eigen(body.position) + rotation * to_eigen(local.position),
                       rotation * to_eigen(local.rotation)};
    if (shape.kind != ShapeKind::compound || index >= shape.part_count) return placed;
    const ShapePart& part = shape.parts[index];
    placed.origin += placed.rotation * to_eigen(part.local.position);
    placed.rotation = placed.rotation * to_eigen(part.local.rotation);
    placed.shape = &part.shape;
    return placed;
}

bool is_convex(ShapeKind kind) {
    return kind != ShapeKind::mesh && kind != ShapeKind::height_field &&
           kind != ShapeKind::compound;
}

bool has_triangles(const Shape& shape) {
    if (shape.kind != ShapeKind::compound)
        return shape.kind == ShapeKind::mesh || shape.kind == ShapeKind::height_field;
    return std::any_of(shape.parts, shape.parts + shape.part_count,
                       [](const ShapePart& part) { return has_triangles(part.shape); });
}

double support(const PlacedShape& s, const Vector3d& d) {
    return s.origin.dot(d) + local_support(*s.shape, s.rotation.conjugate() * d);
}

double inner_radius(const Shape& s) {
    switch (s.kind) {
        case ShapeKind::sphere:
        case ShapeKind::capsule:
            return s.radius;
        case ShapeKind::box:
            return to_eigen(s.half_extents).minCoeff();
        case ShapeKind::cylinder:
            return std::min(s.radius, s.half_height);
        default:
            return -kInfinite;
    }
}

double axis_gap(const PlacedShape& a, const PlacedShape& b, const Vector3d& n) {
    return -support(a, -n) - support(b, n);
}

double extent_of(const Shape& s) {
    if (s.kind == ShapeKind::plane) return kInfinite;
    if (s.kind == ShapeKind::height_field) return height_field_extent(s);
    if (s.kind == ShapeKind::compound) return compound_extent(s);
    double extent = 0;
    for (int k = 0; k < 3; ++k)
        extent = std::max(
            extent, local_support(s, Vector3d::Unit(k)) + local_support(s, -Vector3d::Unit(k)));
    return extent;
}

}  // namespace plumb
