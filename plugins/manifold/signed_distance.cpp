// SPDX-License-Identifier: MIT
/// All in the part's own frame; shapes that are round about y are asked in the half-plane of the
/// point: r from the axis, y along it.
#include "manifold/signed_distance.h"

#include "manifold/triangle.h"

namespace plumb {
namespace {

/// From a core's nearest point and a radius about it; `up` where the point lies on the core.
SurfacePoint around_core(Vec3 p, Vec3 core, double radius, Vec3 up) {
    const Vec3 d = p - core;
    const Vec3 n = unit_or(d, up);
    return {norm(d) - radius, n, core + radius * n, 0};
}

SurfacePoint of_box(Vec3 p, Vec3 half) {
    Vec3 on = p;
    for (int k = 0; k < 3; ++k) at(on, k) = std::clamp(at(p, k), -at(half, k), at(half, k));
    const Vec3 d = p - on;
    const double outside = norm(d);

    // The face that is nearest from inside; also the normal of a point on it.
    int face = 0;
    for (int k = 1; k < 3; ++k)
        if (at(half, k) - std::abs(at(p, k)) < at(half, face) - std::abs(at(p, face))) face = k;
    Vec3 n{};
    at(n, face) = at(p, face) >= 0 ? 1 : -1;
    if (outside > 0) return {outside, unit_or(d, n), on, 0};
    const double depth = at(half, face) - std::abs(at(p, face));
    return {-depth, n, p + depth * n, 0};
}

/// A point of the half-plane r ≥ 0 beside the axis.
struct Flat {
    double r, y;
};
Flat operator-(Flat a, Flat b) { return {a.r - b.r, a.y - b.y}; }
double dot(Flat a, Flat b) { return a.r * b.r + a.y * b.y; }

/// The side of a convex outline: a segment with its outward normal.
struct Side {
    Flat from, to, normal;
};

/// Nearest point of a convex outline in the half-plane.
SurfacePoint of_outline(Vec3 p, const Side* sides, int count) {
    const double r = std::hypot(p.x, p.z);
    const Vec3 out = r > 0 ? Vec3{p.x / r, 0, p.z / r} : Vec3{1, 0, 0};
    const Flat q{r, p.y};
    double most = -1e300, best = 1e300;
    const Side* deepest = sides;
    Flat nearest{};
    for (const Side* s = sides; s < sides + count; ++s) {
        const double height = dot(q - s->from, s->normal);
        if (height > most) most = height, deepest = s;
        const Flat d = s->to - s->from;
        const double t = std::clamp(dot(q - s->from, d) / dot(d, d), 0.0, 1.0);
        const Flat on{s->from.r + t * d.r, s->from.y + t * d.y};
        const double squared = dot(q - on, q - on);
        if (squared < best) best = squared, nearest = on;
    }
    const auto in_space = [&](Flat f) { return f.r * out + Vec3{0, f.y, 0}; };
    const Vec3 flat_normal = in_space(deepest->normal);
    if (most <= 0) return {most, flat_normal, p - most * flat_normal, 0};
    const Vec3 on = in_space(nearest);
    return {std::sqrt(best), unit_or(p - on, flat_normal), on, 0};
}

SurfacePoint of_cylinder(Vec3 p, double r, double h) {
    const Side sides[] = {
        {{0, h}, {r, h}, {0, 1}}, {{r, h}, {r, -h}, {1, 0}}, {{r, -h}, {0, -h}, {0, -1}}};
    return of_outline(p, sides, 3);
}

SurfacePoint of_cone(Vec3 p, double r, double h) {
    const double slant = std::hypot(r, 2 * h);
    const Side sides[] = {{{0, h}, {r, -h}, {2 * h / slant, r / slant}},
                          {{r, -h}, {0, -h}, {0, -1}}};
    return of_outline(p, sides, 2);
}

SurfacePoint of_hull(Vec3 p, const Part& part) {
    const Vec3* v = part.shape.vertices;
    double most = -1e300, best = 1e300;
    const HullFace* deepest = nullptr;
    for (const HullFace& face : part.faces) {
        const double height = dot(face.normal, p - v[face.corners[0]]);
        if (height > most) most = height, deepest = &face;
    }
    const Vec3 n = deepest->normal;
    if (most <= 0) return {most, n, p - most * n, 0};

    // Outside: the nearest point lies on a face that looks at the point.
    Vec3 on = p - most * n;
    for (const HullFace& face : part.faces) {
        const double height = dot(face.normal, p - v[face.corners[0]]);
        if (height <= 0 || height * height >= best) continue;
        for (std::size_t i = 2; i < face.corners.size(); ++i) {
            const Vec3 q = nearest_on_triangle(p, v[face.corners[0]], v[face.corners[i - 1]],
                                               v[face.corners[i]])
                               .point;
            const double squared = dot(p - q, p - q);
            if (squared < best) best = squared, on = q;
        }
    }
    return {std::sqrt(best), unit_or(p - on, n), on, 0};
}

/// Whether a point lies below a height field, and over its grid.
bool below(const Surface& surface, Vec3 p, const Aabb& bounds) {
    if (p.x < bounds.low.x || p.x > bounds.high.x || p.z < bounds.low.z || p.z > bounds.high.z)
        return false;
    if (p.y >= bounds.high.y) return false;
    if (p.y < bounds.low.y) return true;
    return surface.hit(make_ray(p, {0, 1, 0}), bounds.high.y - p.y + 1).found;
}

bool of_surface(SurfacePoint& result, Vec3 p, const Part& part, double within) {
    const Surface& surface = *part.surface;
    const bool field = part.shape.kind == ShapeKind::height_field;
    // Deep inside, the surface may be far and yet be wanted.
    const bool under = field && below(surface, p, part.own_bounds);
    const bool maybe_inside = under || (surface.closed() && overlap({p, p}, part.own_bounds));
    const NearestPoint near =
        surface.nearest(p, maybe_inside ? std::numeric_limits<double>::infinity() : within);
    if (!near.found) return false;

    const Vec3 d = p - near.point;
    const double side = dot(d, near.pseudonormal);
    const bool inside = field ? under : surface.closed() && side < 0;
    const Vec3 outward =
        !field && !surface.closed() && side < 0 ? -near.pseudonormal : near.pseudonormal;
    // On the surface the way to it has no direction of its own.
    const double distance = std::sqrt(near.squared);
    const bool on_it = distance < 1e-12 * (norm(part.own_bounds.high - part.own_bounds.low));
    const Vec3 n = on_it ? outward : (inside ? -1 / distance : 1 / distance) * d;
    result = {inside ? -distance : distance, n, near.point, near.triangle};
    return true;
}

bool in_own_frame(SurfacePoint& result, const Part& part, Vec3 p, double within) {
    const Shape& s = part.shape;
    switch (s.kind) {
        case ShapeKind::plane:
            result = {p.y, {0, 1, 0}, {p.x, 0, p.z}, 0};
            return true;
        case ShapeKind::sphere:
            result = around_core(p, {0, 0, 0}, s.radius, {0, 1, 0});
            return true;
        case ShapeKind::box:
            result = of_box(p, s.half_extents);
            return true;
        case ShapeKind::capsule: {
            const Vec3 core{0, std::clamp(p.y, -s.half_height, s.half_height), 0};
            result = around_core(p, core, s.radius, {1, 0, 0});
            return true;
        }
        case ShapeKind::cylinder:
            result = of_cylinder(p, s.radius, s.half_height);
            return true;
        case ShapeKind::cone:
            result = of_cone(p, s.radius, s.half_height);
            return true;
        case ShapeKind::hull:
            if (part.faces.empty()) return false;
            result = of_hull(p, part);
            return true;
        case ShapeKind::mesh:
        case ShapeKind::height_field:
            return of_surface(result, p, part, within);
        case ShapeKind::compound:
            break;
    }
    return false;
}

}  // namespace

bool signed_distance(SurfacePoint& result, const Part& part, Vec3 point, double within) {
    if (!in_own_frame(result, part, to_inner(part.world, point), within)) return false;
    result.normal = rotated(part.world, result.normal);
    result.point = to_outer(part.world, result.point);
    return result.distance <= within;
}

bool holds_point(const Part& part, Vec3 point) {
    SurfacePoint nearest;
    return signed_distance(nearest, part, point, 0) && nearest.distance < 0;
}

}  // namespace plumb
