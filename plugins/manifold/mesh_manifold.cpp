// SPDX-License-Identifier: MIT
#include "manifold/mesh_manifold.h"

#include "manifold/facet_normal.h"
#include "manifold/mesh_points.h"
#include "manifold/mesh_reduce.h"
#include "manifold/support.h"

#include <limits>

namespace plumb {
namespace {

/// A pair, seen from its two roles.
struct Roles {
    const Part &a, &b;
    bool convex_is_a;
    const Part& convex() const { return convex_is_a ? a : b; }
    const Part& surface() const { return convex_is_a ? b : a; }
};

/// How far the convex part reaches below and above a facet's plane [m], negative below.
struct Heights {
    double low, high;
};

Heights heights_over(const Part& convex, Vec3 on_plane, Vec3 n) {
    const double r = core_radius(convex), plane = dot(n, on_plane);
    return {dot(n, core_support(convex, -n)) - r - plane,
            dot(n, core_support(convex, n)) + r - plane};
}

/// The convex part's bounds in the surface's frame, grown by the margin.
Aabb box_in_surface(const Roles& r) {
    const Frame &outer = r.surface().world, &own = r.convex().world;
    Frame f;
    for (int i = 0; i < 3; ++i) f.axis[i] = turned_back(outer, own.axis[i]);
    f.origin = to_inner(outer, own.origin);
    const double margin = pair_margin(r.a, r.b);
    const Aabb box = bounds_at(r.convex(), f);
    return {box.low - Vec3{margin, margin, margin}, box.high + Vec3{margin, margin, margin}};
}

bool solid_below(const Part& surface) { return surface.shape.kind == ShapeKind::height_field; }

/// The facets whose bounds meet the convex part's; of a height field also those above it.
void find_near(std::vector<std::uint32_t>& facets, const Roles& r) {
    facets.clear();
    Aabb box = box_in_surface(r);
    if (solid_below(r.surface())) box.high.y = std::numeric_limits<double>::infinity();
    r.surface().surface->tree().overlapping(box, [&](std::uint32_t f) { facets.push_back(f); });
    std::sort(facets.begin(), facets.end());
}

void begin_triangle(Part& triangle, const Part& surface) {
    triangle.body = surface.body;
    triangle.index = surface.index;
    triangle.world = surface.world;
    triangle.expansion = surface.expansion;
}

void put_triangle(MeshScratch& scratch, const MeshTopology& mesh, const Facet& facet) {
    Part& t = scratch.triangle;
    for (int i = 0; i < 3; ++i) scratch.corners[i] = mesh.vertices[facet.corner[i]];
    t.own_bounds = {scratch.corners[0], scratch.corners[0]};
    for (const Vec3& p : scratch.corners)
        for (int k = 0; k < 3; ++k) {
            at(t.own_bounds.low, k) = std::min(at(t.own_bounds.low, k), at(p, k));
            at(t.own_bounds.high, k) = std::max(at(t.own_bounds.high, k), at(p, k));
        }
    t.faces[0].normal = facet.normal;
}

/// What is noted in a contact until all triangles were asked.
enum Mark : std::uint32_t {
    kShared = 1,  ///< the normal is not the back-end's own
    kFace = 2     ///< the normal is the triangle's own
};

/// Names a triangle in the contacts from `begin` on, drops those that lie deeper than `most`, and
/// marks the others.
void finish_triangle(ContactList& list, std::size_t begin, const Roles& r, std::uint32_t id,
                     double most, std::uint32_t marks) {
    std::size_t kept = begin;
    for (std::size_t i = begin; i < list.size(); ++i) {
        Contact& c = list.data()[i];
        if (c.gap < -most) continue;
        c.feature = feature_key({c.feature, id});
        c.reserved = marks;
        if (r.surface().index == 0) (r.convex_is_a ? c.part_b : c.part_a) = id;
        list.data()[kept++] = c;
    }
    list.shrink(kept);
}

class Walk {
public:
    Walk(const Roles& roles, TriangleOracle& oracle, MeshScratch& scratch)
        : r_(roles), oracle_(oracle), scratch_(scratch) {
        begin_triangle(scratch.triangle, roles.surface());
    }

    void visit(const Facet& facet) {
        const MeshTopology& mesh = r_.surface().surface->topology();
        const Frame& frame = r_.surface().world;
        const Vec3 n = rotated(frame, facet.normal);
        const Vec3 corner = to_outer(frame, mesh.vertices[facet.corner[0]]);
        const Heights h = heights_over(r_.convex(), corner, n);
        const bool passed = h.high < 0, flat = dot(n, n) < 0.5;
        if (flat || !(h.low <= margin_) || (passed && !solid_)) return;

        put_triangle(scratch_, mesh, facet);
        Witness w;
        const bool known = oracle_.ask(w, first(), second(), facet.id) && finite(w.normal);
        if (!known && h.low >= 0) return;
        if (known && w.gap > margin_ && !passed) return;
        FacetNormal allowed{facet.normal, true};
        if (known) allowed = allowed_normal(mesh, facet, asked_normal(w));
        if (!known) w = {{}, corner, h.low, false, true};
        add(w, facet, rotated(frame, allowed.normal), allowed.corrected);
    }

    /// A body that lies deep in a solid height field: out along the face over its middle.
    void push_out_of_the_deep() {
        const Surface& source = *r_.surface().surface;
        const Part& convex = r_.convex();
        const Vec3 middle = 0.5 * (convex.own_bounds.low + convex.own_bounds.high);
        const Vec3 p = to_inner(r_.surface().world, to_outer(convex.world, middle));
        const double up = source.tree().bounds().high.y + 1 - p.y;
        const SurfaceHit over = source.hit(make_ray(p, {0, 1, 0}), up);
        if (!over.found) return;
        const Facet& facet = source.topology().facets[over.triangle];
        put_triangle(scratch_, source.topology(), facet);
        const Vec3 n = rotated(r_.surface().world, facet.normal);
        const Witness w{r_.convex_is_a ? n : -n, to_outer(r_.surface().world, p), 0, true, true};
        build_manifold(scratch_.corrected, stats_, first(), second(), w);
        finish_triangle(scratch_.corrected, 0, r_, facet.id, 1e300, kShared | kFace);
    }

private:
    const Part& first() const { return r_.convex_is_a ? r_.a : scratch_.triangle; }
    const Part& second() const { return r_.convex_is_a ? scratch_.triangle : r_.b; }

    Vec3 asked_normal(const Witness& w) const {
        const Vec3 n = unit_or(w.normal, {0, 1, 0});
        return turned_back(r_.surface().world, r_.convex_is_a ? n : -n);
    }

    void add(Witness w, const Facet& facet, Vec3 n, bool corrected) {
        const bool face = dot(n, rotated(r_.surface().world, facet.normal)) > 1 - 1e-12;
        w.normal = r_.convex_is_a ? n : -n;
        w.shared = w.shared || corrected;
        ContactList& list = corrected ? scratch_.corrected : scratch_.trusted;
        const std::size_t begin = list.size();
        build_manifold(list, stats_, first(), second(), w,
                       corrected || face ? Fallback::none : Fallback::witness);
        finish_triangle(list, begin, r_, facet.id, most_,
                        (w.shared ? kShared : 0u) | (face ? kFace : 0u));
    }

    const Roles& r_;
    DetectStats stats_{};  ///< not used: what is left is counted at the end
    TriangleOracle& oracle_;
    MeshScratch& scratch_;
    const double margin_ = pair_margin(r_.a, r_.b);
    const bool solid_ = solid_below(r_.surface());
    const double most_ = solid_ ? 1e300 : 2 * r_.convex().half_width;  ///< depth [m]
};

/// A corrected normal may ask for a far longer way out than the pair needs: one row of triangles
/// down the side of a block, say, that a body on top of it presses against. Such contacts go.
double credible_depth(const ContactList& trusted, const ContactList& corrected, double margin) {
    double depth = 0, least = 1e300;
    for (const Contact& c : trusted) depth = std::max(depth, -c.gap);
    for (const Contact& c : corrected)
        if (c.gap < 0) least = std::min(least, -c.gap);
    if (depth <= 0) depth = least;
    return 2 * depth + margin;
}

/// Counts a pair's contacts from `begin` on, and takes the marks of shared normals off them.
void count_contacts(DetectStats& stats, ContactList& out, std::size_t begin) {
    for (std::size_t i = begin; i < out.size(); ++i) {
        Contact& c = out.data()[i];
        ++((c.flags & kContactFallback) ? stats.from_fallback : stats.from_clip);
        stats.shared_normals += c.reserved & kShared;
        c.reserved = 0;
    }
}

}  // namespace

MeshScratch::MeshScratch() {
    triangle.shape.kind = ShapeKind::hull;
    triangle.shape.vertices = corners;
    triangle.shape.vertex_count = 3;
    triangle.faces.push_back({{0, 1, 0}, {0, 1, 2}});
}

void collide_triangles(ContactList& out, DetectStats& stats, const Part& a, const Part& b,
                       TriangleOracle& oracle, MeshScratch& scratch) {
    const Roles roles{a, b, !has_surface(a.shape.kind)};
    const Surface& source = *roles.surface().surface;
    scratch.trusted.clear();
    scratch.corrected.clear();
    find_near(scratch.near, roles);
    if (scratch.near.empty()) return;

    oracle.begin(a, b);
    Walk walk(roles, oracle, scratch);
    for (std::uint32_t f : scratch.near) walk.visit(source.topology().facets[f]);
    if (solid_below(roles.surface()) && scratch.trusted.size() + scratch.corrected.size() == 0)
        walk.push_out_of_the_deep();

    const std::size_t begin = out.size();
    const double credible = credible_depth(scratch.trusted, scratch.corrected, pair_margin(a, b));
    // Of contacts in one place the first stays: rather a face's than that of an edge beside it.
    for (const std::uint32_t face : {std::uint32_t{kFace}, std::uint32_t{0}})
        for (const Contact& c : scratch.trusted)
            if ((c.reserved & kFace) == face) out.push(c);
    for (const Contact& c : scratch.corrected)
        if (-c.gap <= credible) out.push(c);
    reduce_by_planes(out, begin, !roles.convex_is_a);
    tidy_mesh_points(out, begin);
    count_contacts(stats, out, begin);
}

}  // namespace plumb
