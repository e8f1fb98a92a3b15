// SPDX-License-Identifier: MIT
#include "manifold/manifold.h"

#include "manifold/clip.h"
#include "manifold/gjk.h"

namespace plumb {
namespace {

struct Pair {
    const Part &a, &b;
    Vec3 n;
    double gap;  ///< support gap along n [m]
    std::uint32_t flags;
};

Contact& add_contact(ContactList& out, const Pair& pair, Vec3 on_a, Vec3 on_b, double radius_a,
                     double radius_b) {
    Contact& c = out.add(pair.a, pair.b);
    c.point_a = on_a;
    c.point_b = on_b;
    c.normal = pair.n;
    c.radius_a = radius_a;
    c.radius_b = radius_b;
    c.gap = dot(pair.n, on_a - on_b) - radius_a - radius_b;
    c.flags = pair.flags;
    return c;
}

/// A sphere touches in one point, which its centre and the normal tell.
void sphere_contact(ContactList& out, const Pair& pair) {
    const double ra = core_radius(pair.a), rb = core_radius(pair.b);
    const bool a_is_sphere = pair.a.shape.kind == ShapeKind::sphere;
    const Vec3 centre = a_is_sphere ? pair.a.world.origin : pair.b.world.origin;
    const double way = pair.gap + ra + rb;
    const Vec3 on_a = a_is_sphere ? centre : centre + way * pair.n;
    const Vec3 on_b = a_is_sphere ? centre - way * pair.n : centre;
    add_contact(out, pair, on_a, on_b, ra, rb).feature =
        feature_key({1, pair.a.index, pair.b.index});
}

/// The witness moved along the normal onto both supports.
void fallback_contact(ContactList& out, const Pair& pair, Vec3 point) {
    const double ra = core_radius(pair.a), rb = core_radius(pair.b);
    const auto low = [&] {
        return pair.a.shape.kind == ShapeKind::plane ? dot(pair.n, pair.a.world.origin)
                                                     : dot(pair.n, core_support(pair.a, -pair.n));
    }();
    const double at_point = dot(pair.n, point);
    const Vec3 on_a = point + (low - at_point) * pair.n;
    const Vec3 on_b = on_a - (pair.gap + ra + rb) * pair.n;
    Contact& c = add_contact(out, pair, on_a, on_b, ra, rb);
    c.flags = (c.flags & ~kContactClipped) | kContactFallback;
    c.feature = feature_key({2, pair.a.index, pair.b.index});
}

/// The first of the deepest points.
int deepest_of(const FacingPoints& points) {
    int best = 0;
    for (int i = 1; i < points.count; ++i)
        if (points.point[i].gap < points.point[best].gap) best = i;
    return best;
}

/// Leaves at most kMostPoints of an outline: drops the corner that costs least area, never the
/// deepest.
void reduce(FacingPoints& points) {
    while (points.count > kMostPoints) {
        const int deepest = deepest_of(points);
        int least = -1;
        double least_area = 1e300;
        for (int i = 0; i < points.count; ++i) {
            if (i == deepest) continue;
            const Vec3& p = points.point[(i + points.count - 1) % points.count].on_a;
            const Vec3& q = points.point[i].on_a;
            const Vec3& r = points.point[(i + 1) % points.count].on_a;
            const double area = norm(cross(q - p, r - q));
            if (area < least_area) least_area = area, least = i;
        }
        for (int i = least; i + 1 < points.count; ++i) points.point[i] = points.point[i + 1];
        --points.count;
    }
}

void keep_near(FacingPoints& points, double margin) {
    int kept = 0;
    for (int i = 0; i < points.count; ++i)
        if (points.point[i].gap <= margin) points.point[kept++] = points.point[i];
    points.count = kept;
}

/// The faces that look at each other; a plane's is cut to what the other part may cover.
struct Facing {
    SupportFace a, b;
};

Facing facing_of(const Part& a, const Part& b, Vec3 n, double size) {
    const Part& solid = a.shape.kind == ShapeKind::plane ? b : a;
    const Vec3 around = to_outer(solid.world, 0.5 * (solid.own_bounds.low + solid.own_bounds.high));
    return {support_face(a, -n, around, 2 * size), support_face(b, n, around, 2 * size)};
}

/// Whether two of the points are as near as a gap that supports imply.
bool is_reached(double gap, const FacingPoints& points, double size) {
    return points.deepest <= gap + 1e-7 * size;
}

/// Contacts at those of the points that are within the margin.
void add_points(ContactList& out, DetectStats& stats, const Pair& pair, const Facing& facing,
                FacingPoints& points) {
    const SupportFace &face_a = facing.a, &face_b = facing.b;
    keep_near(points, pair_margin(pair.a, pair.b));
    reduce(points);
    for (int i = 0; i < points.count; ++i) {
        // A cylinder that lies on its side is anchored on its axis, as every round shape is on its
        // core.
        const FacingPoints::Point& p = points.point[i];
        const double sa = face_a.side_radius, sb = face_b.side_radius;
        Contact& c = add_contact(out, pair, p.on_a + sa * pair.n, p.on_b - sb * pair.n,
                                 face_a.radius + sa, face_b.radius + sb);
        c.feature = feature_key({3, pair.a.index, pair.b.index, face_a.id, face_b.id, p.feature});
    }
    stats.from_clip += static_cast<std::uint64_t>(points.count);
}

void add_manifold(ContactList& out, DetectStats& stats, const Part& a, const Part& b,
                  const Witness& witness, Fallback fallback) {
    if (!finite(witness.normal) || !finite(witness.point)) return;
    Pair pair{a, b, unit_or(witness.normal, {0, 1, 0}), 0, kContactClipped};
    if (a.shape.kind == ShapeKind::plane) pair.n = -a.world.axis[1];
    if (b.shape.kind == ShapeKind::plane) pair.n = b.world.axis[1];
    pair.gap = support_gap(a, b, pair.n);
    if (!(pair.gap <= pair_margin(a, b))) return;
    if (witness.approximate) pair.flags |= kContactApproximate;

    const bool sphere = a.shape.kind == ShapeKind::sphere || b.shape.kind == ShapeKind::sphere;
    if (sphere && fallback == Fallback::witness) {
        ++stats.from_clip;
        return sphere_contact(out, pair);
    }

    const double size = size_of(a) + size_of(b);
    const Facing facing = facing_of(a, b, pair.n, size);
    FacingPoints points = facing_points(facing.a, facing.b, pair.n);

    if (fallback == Fallback::witness && points.deepest > pair.gap + 1e-6 * size) {
        ++stats.from_fallback;
        Vec3 point = witness.point;
        if (b.shape.kind == ShapeKind::plane)
            point = core_support(a, -pair.n);
        else if (a.shape.kind == ShapeKind::plane)
            point = core_support(b, pair.n);
        else
            touching_point(point, a, b, pair.n, pair.gap);
        fallback_contact(out, pair, point);
    }
    add_points(out, stats, pair, facing, points);
}

}  // namespace

bool gap_is_reached(const Part& a, const Part& b, Vec3 n) {
    const double size = size_of(a) + size_of(b);
    const Facing facing = facing_of(a, b, n, size);
    return is_reached(support_gap(a, b, n), facing_points(facing.a, facing.b, n), size);
}

bool build_where_reached(ContactList& out, DetectStats& stats, const Part& a, const Part& b, Vec3 n,
                         double gap) {
    const double size = size_of(a) + size_of(b);
    const Facing facing = facing_of(a, b, n, size);
    FacingPoints points = facing_points(facing.a, facing.b, n);
    if (!is_reached(gap, points, size)) return false;
    add_points(out, stats, {a, b, n, gap, kContactClipped}, facing, points);
    return true;
}

void build_manifold(ContactList& out, DetectStats& stats, const Part& a, const Part& b,
                    const Witness& witness, Fallback fallback) {
    const std::size_t before = out.size();
    add_manifold(out, stats, a, b, witness, fallback);
    if (witness.shared) stats.shared_normals += out.size() - before;
}

void add_raw(ContactList& out, DetectStats& stats, const Part& a, const Part& b,
             const Witness& witness, std::uint64_t feature) {
    if (!finite(witness.normal) || !finite(witness.point) || !(witness.gap <= pair_margin(a, b)))
        return;
    const Vec3 n = unit_or(witness.normal, {0, 0, 0});  // none: the host leaves it out and counts
    const std::uint32_t flags = witness.approximate ? kContactApproximate : 0u;
    const Pair pair{a, b, n, witness.gap, flags | kContactExact};
    const Vec3 half = 0.5 * witness.gap * n;
    Contact& c = add_contact(out, pair, witness.point + half, witness.point - half, 0, 0);
    if (witness.approximate) c.flags = kContactApproximate;
    if (feature != 0) c.feature = feature_key({4, a.index, b.index, feature});
    ++stats.from_backend;
}

}  // namespace plumb
