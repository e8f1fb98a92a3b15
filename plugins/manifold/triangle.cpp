// SPDX-License-Identifier: MIT
#include "manifold/triangle.h"

#include <limits>

namespace plumb {
namespace {

TrianglePoint nearest_on_edge(Vec3 p, Vec3 from, Vec3 to, int k) {
    const Vec3 d = to - from;
    const double along = dot(p - from, d), whole = dot(d, d);
    if (!(along > 0)) return {from, k, -1};
    if (along >= whole) return {to, (k + 1) % 3, -1};
    return {from + (along / whole) * d, -1, k};
}

}  // namespace

TrianglePoint nearest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    // Inside of all three edges, seen along the normal: the foot of the perpendicular.
    const Vec3 n = cross(b - a, c - a);
    const double nn = dot(n, n);
    const double u = dot(n, cross(b - a, p - a)), v = dot(n, cross(c - b, p - b)),
                 w = dot(n, cross(a - c, p - c));
    if (nn > 0 && u > 0 && v > 0 && w > 0) return {p - (dot(n, p - a) / nn) * n, -1, -1};

    // Else on the border: the nearest of the edges, the first where they are alike.
    const auto squared = [&](const TrianglePoint& q) { return dot(p - q.point, p - q.point); };
    TrianglePoint best = nearest_on_edge(p, a, b, 0);
    for (const TrianglePoint& other : {nearest_on_edge(p, b, c, 1), nearest_on_edge(p, c, a, 2)})
        if (squared(other) < squared(best)) best = other;
    return best;
}

double ray_to_triangle(Vec3 o, Vec3 d, Vec3 a, Vec3 b, Vec3 c) {
    constexpr double kMiss = std::numeric_limits<double>::infinity();
    // Corners seen from the origin; the ray passes inside where it turns one way about all edges.
    const Vec3 p = a - o, q = b - o, r = c - o;
    const Vec3 n = cross(q - p, r - p);
    const double facing = dot(n, d);
    if (facing == 0) return kMiss;
    const double sign = facing > 0 ? 1 : -1;
    const double u = sign * dot(d, cross(p, q)), v = sign * dot(d, cross(q, r)),
                 w = sign * dot(d, cross(r, p));
    // A ray through an edge must not slip between its triangles.
    const double size = std::max({dot(p, p), dot(q, q), dot(r, r)});
    const double slack = -1e-14 * size;
    if (u < slack || v < slack || w < slack) return kMiss;
    const double distance = dot(n, p) / facing;
    return distance >= 0 ? distance : kMiss;
}

}  // namespace plumb
