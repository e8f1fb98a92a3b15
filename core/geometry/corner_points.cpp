// SPDX-License-Identifier: MIT
#include "geometry/corner_points.h"

#include "scene/coincident_points.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Points closer than this share of the shape's size are one.
constexpr double kOnePlace = 1e-9;

/// Points of a rim, enough that its polygon is off by 3 % of the radius.
constexpr int kRimPoints = 12;

void add_rim(std::vector<CornerPoint>& points, double radius, double y) {
    constexpr double kTurn = 6.283185307179586;
    for (int i = 0; i < kRimPoints; ++i) {
        const double angle = kTurn * i / kRimPoints;
        points.push_back({{radius * std::cos(angle), y, radius * std::sin(angle)}});
    }
}

/// Balls along a capsule's core, no further apart than its radius unless it is very long.
void add_core(std::vector<CornerPoint>& points, const Shape& s) {
    const int spaces = std::max(1, int(std::min(64.0, std::ceil(2 * s.half_height / s.radius))));
    for (int i = 0; i <= spaces; ++i)
        points.push_back({{0, s.half_height * (2.0 * i / spaces - 1), 0}, s.radius});
}

void add_parts(std::vector<CornerPoint>& points, const Shape& s) {
    for (std::uint32_t i = 0; i < s.part_count; ++i) {
        const Pose& local = s.parts[i].local;
        const Quaterniond rotation(local.rotation.w, local.rotation.x, local.rotation.y,
                                   local.rotation.z);
        for (const CornerPoint& p : corner_points(s.parts[i].shape))
            points.push_back({to_eigen(local.position) + rotation * p.position, p.radius});
    }
    // parts that were cut from one shape share their corners
    std::vector<Vector3d> places;
    for (const CornerPoint& p : points) places.push_back(p.position);
    const std::vector<std::uint32_t> first = first_at_place(places, kOnePlace * size_of(places));
    std::vector<CornerPoint> kept;
    for (std::uint32_t i = 0; i < points.size(); ++i)
        if (first[i] == i || points[i].radius > 0) kept.push_back(points[i]);
    points.swap(kept);
}

}  // namespace

std::vector<CornerPoint> corner_points(const Shape& s) {
    std::vector<CornerPoint> points;
    switch (s.kind) {
        case ShapeKind::sphere:
            points.push_back({Vector3d::Zero(), s.radius});
            break;
        case ShapeKind::box:
            for (int i = 0; i < 8; ++i)
                points.push_back({{i & 1 ? s.half_extents.x : -s.half_extents.x,
                                   i & 2 ? s.half_extents.y : -s.half_extents.y,
                                   i & 4 ? s.half_extents.z : -s.half_extents.z}});
            break;
        case ShapeKind::capsule:
            add_core(points, s);
            break;
        case ShapeKind::cylinder:
            add_rim(points, s.radius, s.half_height);
            add_rim(points, s.radius, -s.half_height);
            break;
        case ShapeKind::cone:
            add_rim(points, s.radius, -s.half_height);
            points.push_back({{0, s.half_height, 0}});
            break;
        case ShapeKind::hull:
        case ShapeKind::mesh:
            for (std::uint32_t i = 0; i < s.vertex_count; ++i)
                points.push_back({to_eigen(s.vertices[i])});
            break;
        case ShapeKind::compound:
            add_parts(points, s);
            break;
        case ShapeKind::plane:
        case ShapeKind::height_field:
            break;
    }
    return points;
}

}  // namespace plumb
