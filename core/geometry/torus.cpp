// SPDX-License-Identifier: MIT
/// R ring radius, r tube radius, S segments, c = cos(π/S).
///
/// A wedge reaches from −π/S to +π/S. The edges between its two ends are straight, so at the angle
/// φ the outline of its ends appears with distances from the axis times k = c / cos φ, from c in
/// the middle to 1 at the ends. The tube's circle fits in at each φ if the outline holds the circle
/// and the circle stretched by 1/c away from the axis. The outline is the polygon of `sides`
/// tangents to the two.
#include "geometry/torus.h"

#include <cmath>
#include <numbers>

#include "geometry/hull.h"

namespace plumb {

namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;

/// Distance from the origin of the tangent with normal (cos t, sin t), in the plane (ρ, y) [m].
double support(const Torus& torus, double t) {
    const double c = std::cos(kPi / torus.segments), x = std::cos(t), y = std::sin(t);
    const double circle = torus.ring_radius * x + torus.tube_radius;
    const double stretched = torus.ring_radius * x / c + torus.tube_radius * std::hypot(x / c, y);
    return std::max(circle, stretched);
}

}  // namespace

std::vector<Vector2d> outline_of(const Torus& torus) {
    std::vector<Vector2d> corners;
    for (std::uint32_t i = 0; i < torus.sides; ++i) {
        const double t = 2 * kPi * i / torus.sides, u = 2 * kPi * (i + 1) / torus.sides;
        const double a = support(torus, t), b = support(torus, u), d = std::sin(u - t);
        corners.emplace_back((a * std::sin(u) - b * std::sin(t)) / d,
                             (b * std::cos(t) - a * std::cos(u)) / d);
    }
    return corners;
}

std::vector<GeometryPart> wedges_of(const Torus& torus) {
    const std::vector<Vector2d> corners = outline_of(torus);
    std::vector<GeometryPart> wedges;
    for (std::uint32_t i = 0; i < torus.segments; ++i) {
        std::vector<Eigen::Vector3d> points;
        for (const std::uint32_t end : {i, i + 1}) {
            const double phi = 2 * kPi * (end % torus.segments) / torus.segments;
            for (const Vector2d& p : corners)
                points.emplace_back(p.x() * std::cos(phi), p.y(), p.x() * std::sin(phi));
        }
        Hull hull = convex_hull(points);
        GeometryPart& wedge = wedges.emplace_back();
        wedge.geometry.kind = ShapeKind::hull;
        wedge.geometry.vertices = std::move(hull.vertices);
        wedge.geometry.faces = std::move(hull.faces);
    }
    return wedges;
}

}  // namespace plumb
