// SPDX-License-Identifier: MIT
#include "manifold/closest.h"

#include "manifold/gjk.h"
#include "manifold/support.h"

namespace plumb {
namespace {

bool is(const Part& part, ShapeKind kind) { return part.shape.kind == kind; }

Contact blank(const Part& a, const Part& b) {
    Contact c{};
    c.a = a.body, c.b = b.body;
    c.part_a = a.index, c.part_b = b.index;
    c.feature = feature_key({7, a.index, b.index});
    return c;
}

/// A ball as a or b, anything as the other.
bool closest_to_ball(Contact& c, const Part& a, const Part& b) {
    const bool ball_first = is(a, ShapeKind::sphere);
    const Part &ball = ball_first ? a : b, &other = ball_first ? b : a;
    SurfacePoint nearest;
    if (!signed_distance(nearest, other, ball.world.origin, kInfinity)) return false;
    c = blank(ball, other);
    fill_ball_contact(c, ball.world.origin, ball.shape.radius, other, nearest);
    if (!ball_first) turn_round(c);
    return true;
}

/// Farthest point of a part's core along d; also of meshes and height fields.
Vec3 farthest(const Part& part, Vec3 d) {
    if (!part.surface) return core_support(part, d);
    const Vec3 own = turned_back(part.world, d);
    double most = -kInfinity;
    Vec3 best{};
    for (std::uint32_t t = 0; t < part.surface->size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const double along = dot(part.surface->corner(t, k), own);
            if (along > most) most = along, best = part.surface->corner(t, k);
        }
    return to_outer(part.world, best);
}

/// Anchors of both parts, the normal out of b towards a and the gap between them.
void fill(Contact& c, const Part& a, const Part& b, Vec3 on_a, Vec3 n, double gap) {
    c.normal = n;
    c.gap = gap;
    c.radius_a = core_radius(a), c.radius_b = core_radius(b);
    c.point_a = on_a + c.radius_a * n;
    c.point_b = on_a - gap * n - c.radius_b * n;
    c.flags = kContactExact;
}

void closest_to_plane(Contact& c, const Part& a, const Part& b) {
    const bool plane_first = is(a, ShapeKind::plane);
    const Part &plane = plane_first ? a : b, &solid = plane_first ? b : a;
    const Vec3 up = plane.world.axis[1];
    const Vec3 on = farthest(solid, -up) - core_radius(solid) * up;
    c = blank(solid, plane);
    fill(c, solid, plane, on, up, dot(up, on - plane.world.origin));
    if (plane_first) turn_round(c);
}

void fill_from(Contact& c, const Part& a, const Part& b, const Witness& w) {
    c = blank(a, b);
    fill(c, a, b, w.point + (0.5 * w.gap) * w.normal, w.normal, w.gap);
}

/// A triangle in the shape of a part, for the closest points of convex parts.
class TrianglePart {
public:
    TrianglePart() {
        part.shape.kind = ShapeKind::hull;
        part.shape.vertices = corner_;
        part.shape.vertex_count = 3;
        part.world = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    }
    TrianglePart(const TrianglePart&) = delete;
    TrianglePart& operator=(const TrianglePart&) = delete;

    void set(Vec3 p, Vec3 q, Vec3 r) {
        corner_[0] = p, corner_[1] = q, corner_[2] = r;
        for (int k = 0; k < 3; ++k) {
            at(part.own_bounds.low, k) = std::min({at(p, k), at(q, k), at(r, k)});
            at(part.own_bounds.high, k) = std::max({at(p, k), at(q, k), at(r, k)});
        }
    }

    Part part;

private:
    Vec3 corner_[3];
};

/// The best so far of the triangles of b, in the frame of b.
struct Search {
    const Part& b;
    TrianglePart triangle;
    Witness best{{0, 1, 0}, {0, 0, 0}, kInfinity, false, false};
    std::uint32_t number_a = 0, number_b = 0;
    bool meet = false;

    /// Asks a convex part, in the frame of b, against all triangles that may be nearer than the
    /// best.
    void ask(const Part& convex, std::uint32_t number) {
        const Surface& surface = *b.surface;
        const auto limit = [this] { return meet ? -1.0 : best.gap * best.gap; };
        surface.tree().near(bounds_of(convex), limit, [&](std::uint32_t t) {
            if (meet) return;
            triangle.set(surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2));
            Witness w;
            if (!closest_when_apart(w, convex, triangle.part) || w.gap <= 0) {
                meet = true;
            } else if (w.gap < best.gap) {
                best = w;
                number_a = number, number_b = surface.number(t);
            }
        });
    }
};

Frame inverse(const Frame& f) {
    const Vec3* a = f.axis;
    const Frame turned{
        {{a[0].x, a[1].x, a[2].x}, {a[0].y, a[1].y, a[2].y}, {a[0].z, a[1].z, a[2].z}}, {0, 0, 0}};
    return {{turned.axis[0], turned.axis[1], turned.axis[2]}, -rotated(turned, f.origin)};
}

/// What lies wholly in the other is moved out along the way to the surface that is nearest.
void leave(Contact& c, const Part& a, const Part& b, bool a_is_inside) {
    const Part& inner = a_is_inside ? a : b;
    const Vec3 n = -c.normal, along = a_is_inside ? -n : n;
    const Vec3 surface =
        a_is_inside ? c.point_b + c.radius_b * c.normal : c.point_a - c.radius_a * c.normal;
    const Vec3 deepest = farthest(inner, along) + core_radius(inner) * along;
    const double gap = -dot(along, deepest - surface);
    fill(c, a, b, a_is_inside ? deepest : deepest + gap * n, n, gap);
    c.flags = kContactApproximate;
}

/// a any bounded part, b a mesh or a height field.
Closeness closest_to_surface(Contact& c, const Part& a, const Part& b) {
    Search search{b, {}, {{0, 1, 0}, {0, 0, 0}, kInfinity, false, false}, 0, 0, false};
    const Frame a_in_b = inverse(b.world) * a.world;
    if (a.surface) {
        TrianglePart own;
        for (std::uint32_t t = 0; t < a.surface->size() && !search.meet; ++t) {
            own.set(to_outer(a_in_b, a.surface->corner(t, 0)),
                    to_outer(a_in_b, a.surface->corner(t, 1)),
                    to_outer(a_in_b, a.surface->corner(t, 2)));
            search.ask(own.part, a.surface->number(t));
        }
    } else {
        Part moved = a;
        moved.world = a_in_b;
        search.ask(moved, 0);
    }
    if (search.meet) return Closeness::meet;
    if (!std::isfinite(search.best.gap)) return Closeness::nothing;

    Witness w = search.best;
    w.normal = rotated(b.world, w.normal);
    w.point = to_outer(b.world, w.point);
    fill_from(c, a, b, w);
    if (!a.in_compound && a.surface) c.part_a = search.number_a;
    if (!b.in_compound) c.part_b = search.number_b;
    if (holds_point(b, c.point_a - c.radius_a * c.normal))
        leave(c, a, b, true);
    else if (holds_point(a, c.point_b))
        leave(c, a, b, false);
    return Closeness::found;
}

}  // namespace

Closeness closest_of_parts(Contact& c, const Part& a, const Part& b) {
    const auto either = [&](ShapeKind kind) { return is(a, kind) || is(b, kind); };
    if (is(a, ShapeKind::plane) && is(b, ShapeKind::plane)) return Closeness::nothing;
    if (either(ShapeKind::sphere))
        return closest_to_ball(c, a, b) ? Closeness::found : Closeness::nothing;
    if (either(ShapeKind::plane)) return closest_to_plane(c, a, b), Closeness::found;
    if (b.surface) return closest_to_surface(c, a, b);
    if (a.surface) {
        const Closeness answer = closest_to_surface(c, b, a);
        if (answer == Closeness::found) turn_round(c);
        return answer;
    }
    Witness w;
    if (!closest_when_apart(w, a, b) || w.gap <= 0) return Closeness::meet;
    fill_from(c, a, b, w);
    return Closeness::found;
}

bool closest_of_smaller(Contact& c, const Part& a, const Part& b) {
    Witness w;
    if (a.surface || b.surface || !closest_when_touching(w, a, b)) return false;
    fill_from(c, a, b, w);
    c.flags = kContactApproximate;
    return true;
}

}  // namespace plumb
