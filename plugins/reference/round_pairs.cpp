// SPDX-License-Identifier: MIT
/// Pairs with a sphere, a capsule or a plane, in closed form.
///
/// A round shape is its core (a point, a segment) and a radius; most pairs are then closest points
/// of the cores.
#include "reference/narrow.h"

namespace plumb::reference {
namespace {

constexpr Vec3 kUp{0, 1, 0};

/// The point of a segment nearest to `p`.
Vec3 nearest_on(const Segment& s, Vec3 p) {
    const Vec3 d = s.to - s.from;
    const double dd = dot(d, d);
    const double t = dd > 1e-24 ? dot(p - s.from, d) / dd : 0;
    return s.from + std::min(1.0, std::max(0.0, t)) * d;
}

/// Normal out of the plane's solid, seen from the other shape: out of y towards the plane x.
Vec3 towards_plane(const Part& plane) { return -plane.world.axis[1]; }

/// The point of the plane under (or above) `p`.
Vec3 foot_on(const Part& plane, Vec3 p) {
    const Vec3 up = plane.world.axis[1];
    return p - dot(up, p - plane.world.origin) * up;
}

}  // namespace

void plane_sphere(const Emitter& e) {
    const Vec3 c = e.y.world.origin;
    e.point(foot_on(e.x, c), c, towards_plane(e.x), 0, e.y.shape.radius, 1);
}

void plane_capsule(const Emitter& e) {
    const Segment core = core_of(e.y);
    const Vec3 n = towards_plane(e.x);
    e.point(foot_on(e.x, core.from), core.from, n, 0, e.y.shape.radius, 1);
    if (e.y.shape.half_height > 0)
        e.point(foot_on(e.x, core.to), core.to, n, 0, e.y.shape.radius, 2);
}

void plane_box(const Emitter& e) {
    // The box's face that looks into the plane holds the deepest corner.
    const Box box = box_of(e.y);
    const Vec3 n = towards_plane(e.x);
    int k = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(dot(box.axis[i], n)) > std::abs(dot(box.axis[k], n)) + 1e-9) k = i;
    const double side = dot(box.axis[k], n) >= 0 ? 1 : -1;
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    for (int corner = 0; corner < 4; ++corner) {
        const double su = corner & 1 ? 1 : -1, sv = corner & 2 ? 1 : -1;
        const Vec3 p = box.centre + side * box.half[k] * box.axis[k] +
                       su * box.half[u] * box.axis[u] + sv * box.half[v] * box.axis[v];
        const unsigned id =
            (side > 0 ? 1u << k : 0u) | (su > 0 ? 1u << u : 0u) | (sv > 0 ? 1u << v : 0u);
        e.point(foot_on(e.x, p), p, n, 0, 0, 1 + id);
    }
}

void sphere_sphere(const Emitter& e) {
    const Vec3 c = e.x.world.origin, d = e.y.world.origin;
    e.point(c, d, unit_or(c - d, kUp), e.x.shape.radius, e.y.shape.radius, 1);
}

void sphere_capsule(const Emitter& e) {
    const Vec3 c = e.x.world.origin;
    const Vec3 q = nearest_on(core_of(e.y), c);
    const Vec3 n = unit_or(c - q, any_perpendicular(e.y.world.axis[1]));
    e.point(c, q, n, e.x.shape.radius, e.y.shape.radius, 1);
}

void sphere_box(const Emitter& e) {
    const Vec3 c = to_inner(e.y.world, e.x.world.origin);
    const Vec3 h = e.y.shape.half_extents;
    Vec3 q = c;
    for (int i = 0; i < 3; ++i) at(q, i) = std::min(at(h, i), std::max(-at(h, i), at(c, i)));

    const Vec3 away = c - q;
    Vec3 n{};
    if (norm(away) > 1e-12) {
        n = (1 / norm(away)) * away;
    } else {
        // The centre is inside: out through the nearest face.
        int k = 0;
        for (int i = 1; i < 3; ++i)
            if (at(h, i) - std::abs(at(c, i)) < at(h, k) - std::abs(at(c, k))) k = i;
        at(n, k) = at(c, k) >= 0 ? 1 : -1;
        q = c;
        at(q, k) = at(n, k) * at(h, k);
    }
    e.point(e.x.world.origin, to_outer(e.y.world, q), rotated(e.y.world, n), e.x.shape.radius, 0,
            1);
}

namespace {

/// Two points where nearly parallel capsules lie along each other; false where they do not.
bool parallel_capsules(const Emitter& e, Vec3 n) {
    const Vec3 u = e.x.world.axis[1], w = e.y.world.axis[1];
    if (norm(cross(u, w)) > 0.01 || std::abs(dot(n, u)) > 0.05) return false;

    // The stretch that both cores cover, along the first one's axis.
    const Vec3 offset = e.y.world.origin - e.x.world.origin;
    const double middle = dot(offset, u), half = e.y.shape.half_height * std::abs(dot(w, u));
    const double low = std::max(-e.x.shape.half_height, middle - half);
    const double high = std::min(e.x.shape.half_height, middle + half);
    if (high - low < 1e-6) return false;
    for (int end = 0; end < 2; ++end) {
        const double s = end ? high : low;
        const Vec3 p = e.x.world.origin + s * u;
        const Vec3 q = e.y.world.origin + ((s - middle) / dot(w, u)) * w;
        e.point(p, p - dot(n, p - q) * n, n, e.x.shape.radius, e.y.shape.radius, 2 + end);
    }
    return true;
}

}  // namespace

void capsule_capsule(const Emitter& e) {
    const Segment a = core_of(e.x), b = core_of(e.y);
    const SegmentPair at_best = closest_of_segments(a.from, a.to - a.from, b.from, b.to - b.from);
    const Vec3 p = a.from + at_best.s * (a.to - a.from), q = b.from + at_best.t * (b.to - b.from);

    // Cores that cross: push along the common perpendicular.
    const Vec3 across = cross(e.x.world.axis[1], e.y.world.axis[1]);
    const Vec3 fallback =
        norm(across) > 1e-6 ? unit_or(across, kUp) : any_perpendicular(e.x.world.axis[1]);
    const Vec3 n = unit_or(p - q, fallback);
    if (!parallel_capsules(e, n)) e.point(p, q, n, e.x.shape.radius, e.y.shape.radius, 1);
}

}  // namespace plumb::reference
