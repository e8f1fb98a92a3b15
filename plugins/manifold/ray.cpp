// SPDX-License-Identifier: MIT
/// All in the part's own frame. The ray's origin o is first moved to the point of its line nearest
/// to the shape's middle, so that a far origin costs no digits; `from` is where the ray itself
/// begins, seen from there.
#include "manifold/ray.h"

#include "manifold/signed_distance.h"

namespace plumb {
namespace {

struct Line {
    Vec3 o, d;
    double from;  ///< [m], hits before it are behind the ray
};

/// The nearest of the hits that were offered.
struct Nearest {
    const Line& line;
    double t = std::numeric_limits<double>::infinity();
    Vec3 normal{};

    /// Where the line goes in; a beginning on the surface counts.
    void offer(double at, Vec3 n) {
        const double first = line.from - 1e-12 * (1 + std::abs(line.from));
        if (at >= first && at < t && dot(n, line.d) <= 0) t = at, normal = n;
    }
    Vec3 point(double at) const { return line.o + at * line.d; }
};

/// Roots of a t² + 2 b t + c, the lower first; false where there are none.
bool roots(double a, double b, double c, double (&t)[2]) {
    if (a == 0) {
        if (b == 0) return false;
        t[0] = t[1] = -0.5 * c / b;
        return true;
    }
    const double under = b * b - a * c;
    if (!(under >= 0)) return false;
    // The root of larger size first; the other follows from their product.
    const double q = -(b + std::copysign(std::sqrt(under), b));
    t[0] = q / a;
    t[1] = q != 0 ? c / q : t[0];
    if (t[1] < t[0]) std::swap(t[0], t[1]);
    return true;
}

void hit_ball(Nearest& best, Vec3 centre, double radius) {
    const Line& l = best.line;
    const Vec3 o = l.o - centre;
    double t[2];
    if (roots(dot(l.d, l.d), dot(o, l.d), dot(o, o) - radius * radius, t))
        best.offer(t[0], (1 / radius) * (best.point(t[0]) - centre));
}

/// The round side |y| ≤ h of a cylinder.
void hit_side(Nearest& best, double radius, double h) {
    const Line& l = best.line;
    double t[2];
    const double a = l.d.x * l.d.x + l.d.z * l.d.z, b = l.o.x * l.d.x + l.o.z * l.d.z;
    if (a == 0 || !roots(a, b, l.o.x * l.o.x + l.o.z * l.o.z - radius * radius, t)) return;
    const Vec3 p = best.point(t[0]);
    if (std::abs(p.y) <= h) best.offer(t[0], {p.x / radius, 0, p.z / radius});
}

/// A flat round end at height y, seen from the side of its normal, ±y.
void hit_disc(Nearest& best, double radius, double y, double side) {
    const Line& l = best.line;
    if (!(side * l.d.y < 0)) return;
    const double t = (y - l.o.y) / l.d.y;
    const Vec3 p = best.point(t);
    if (p.x * p.x + p.z * p.z <= radius * radius) best.offer(t, {0, side, 0});
}

/// The mantle: x² + z² = k² u² with u = h − y in [0, 2h] and k = r / 2h.
void hit_mantle(Nearest& best, double radius, double h) {
    const Line& l = best.line;
    const double k = radius / (2 * h), u = h - l.o.y, du = -l.d.y;
    double t[2];
    if (!roots(l.d.x * l.d.x + l.d.z * l.d.z - k * k * du * du,
               l.o.x * l.d.x + l.o.z * l.d.z - k * k * u * du,
               l.o.x * l.o.x + l.o.z * l.o.z - k * k * u * u, t))
        return;
    for (double at_t : t) {
        const Vec3 p = best.point(at_t);
        const Vec3 n = unit_or({p.x, k * k * (h - p.y), p.z}, {0, 1, 0});
        if (std::abs(p.y) <= h) best.offer(at_t, n);
    }
}

/// What is left of the line inside of all half-spaces n·(p − q) ≤ 0, one after the other.
struct Cut {
    const Line& line;
    double in = -std::numeric_limits<double>::infinity();
    double out = std::numeric_limits<double>::infinity();
    Vec3 normal{};

    void by(Vec3 n, Vec3 q) {
        const double height = dot(n, line.o - q), fall = dot(n, line.d);
        if (fall == 0) {
            if (height > 0) in = std::numeric_limits<double>::infinity();
            return;
        }
        const double t = -height / fall;
        if (fall < 0 && t > in) in = t, normal = n;
        if (fall > 0) out = std::min(out, t);
    }
    void offer_to(Nearest& best) const {
        if (in <= out) best.offer(in, normal);
    }
};

void hit_box(Nearest& best, Vec3 half) {
    Cut cut{best.line};
    for (int k = 0; k < 3; ++k)
        for (double side : {1.0, -1.0}) {
            Vec3 n{};
            at(n, k) = side;
            cut.by(n, at(half, k) * n);
        }
    cut.offer_to(best);
}

void hit_hull(Nearest& best, const Part& part) {
    Cut cut{best.line};
    for (const HullFace& face : part.faces)
        cut.by(face.normal, part.shape.vertices[face.corners[0]]);
    cut.offer_to(best);
}

void hit_convex(Nearest& best, const Part& part) {
    const Shape& s = part.shape;
    const double r = s.radius, h = s.half_height;
    switch (s.kind) {
        case ShapeKind::plane:
            if (best.line.d.y < 0) best.offer(-best.line.o.y / best.line.d.y, {0, 1, 0});
            break;
        case ShapeKind::sphere:
            hit_ball(best, {0, 0, 0}, r);
            break;
        case ShapeKind::box:
            hit_box(best, s.half_extents);
            break;
        case ShapeKind::capsule:
            hit_side(best, r, h);
            hit_ball(best, {0, h, 0}, r);
            hit_ball(best, {0, -h, 0}, r);
            break;
        case ShapeKind::cylinder:
            hit_side(best, r, h);
            hit_disc(best, r, h, 1);
            hit_disc(best, r, -h, -1);
            break;
        case ShapeKind::cone:
            hit_mantle(best, r, h);
            hit_disc(best, r, -h, -1);
            break;
        case ShapeKind::hull:
            hit_hull(best, part);
            break;
        default:
            break;
    }
}

bool hit_surface(PartHit& hit, const Part& part, Vec3 origin, Vec3 direction, double length) {
    const SurfaceHit found = part.surface->hit(make_ray(origin, direction), length);
    if (!found.found) return false;
    const bool sheet = part.shape.kind == ShapeKind::mesh && !part.surface->closed();
    const bool from_behind = dot(found.normal, direction) > 0;
    hit = {found.distance, sheet && from_behind ? -found.normal : found.normal, found.triangle};
    return true;
}

}  // namespace

bool cast_ray(PartHit& hit, const Part& part, const Ray& ray, double length) {
    if (holds_point(part, ray.origin)) {
        hit = {0, -ray.direction, 0};
        return true;
    }
    const Vec3 o = to_inner(part.world, ray.origin), d = turned_back(part.world, ray.direction);
    if (has_surface(part.shape.kind)) {
        if (!hit_surface(hit, part, o, d, length)) return false;
    } else {
        const double to_middle = dot(part.own_bounds.low + part.own_bounds.high, d) * 0.5;
        const double moved = to_middle - dot(o, d);
        const Line line{o + moved * d, d, -moved};
        Nearest best{line};
        hit_convex(best, part);
        if (!std::isfinite(best.t)) return false;
        hit = {std::max(0.0, best.t + moved), best.normal, 0};
    }
    hit.normal = rotated(part.world, hit.normal);
    return hit.distance <= length;
}

}  // namespace plumb
