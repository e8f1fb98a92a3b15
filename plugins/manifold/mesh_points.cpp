// SPDX-License-Identifier: MIT
#include "manifold/mesh_points.h"

namespace plumb {
namespace {

bool same_place(const Contact& p, const Contact& q) {
    const Vec3 d = p.point_b - q.point_b;
    return dot(d, d) < 1e-12 && dot(p.normal, q.normal) > 1 - 1e-6;
}

void drop_repeated(ContactList& contacts, std::size_t begin) {
    Contact* all = contacts.data();
    std::size_t kept = begin;
    for (std::size_t i = begin; i < contacts.size(); ++i) {
        const bool repeated = std::any_of(all + begin, all + kept,
                                          [&](const Contact& c) { return same_place(c, all[i]); });
        if (!repeated) all[kept++] = all[i];
    }
    contacts.shrink(kept);
}

void thin_out(ContactList& out, std::size_t begin, std::size_t most) {
    Contact* all = out.data() + begin;
    const std::size_t count = out.size() - begin;
    if (count <= most) return;
    // The deepest first; then, again and again, the one farthest from all that were taken. A point
    // that differs in normal counts as far away, so that a wedge between two walls keeps both.
    static thread_local std::vector<double> distance;  // so that a pair allocates nothing
    distance.assign(count, 1e300);
    std::size_t next = 0;
    for (std::size_t i = 1; i < count; ++i)
        if (all[i].gap < all[next].gap) next = i;
    for (std::size_t taken = 0; taken < most; ++taken) {
        std::swap(all[taken], all[next]);
        std::swap(distance[taken], distance[next]);
        next = taken + 1;
        for (std::size_t i = taken + 1; i < count; ++i) {
            const Vec3 d = all[i].point_a - all[taken].point_a,
                       m = all[i].normal - all[taken].normal;
            distance[i] = std::min(distance[i], dot(d, d) + 0.01 * dot(m, m));
            if (distance[i] > distance[next]) next = i;
        }
    }
    out.shrink(begin + most);
}

}  // namespace

void anchor_sphere(Contact& c, const Part& a, const Part& b) {
    if (a.shape.kind == ShapeKind::sphere) {
        c.point_a = a.world.origin;
        c.radius_a = a.shape.radius;
        c.point_b = c.point_a - (c.radius_a + c.gap) * c.normal;
    } else if (b.shape.kind == ShapeKind::sphere) {
        c.point_b = b.world.origin;
        c.radius_b = b.shape.radius;
        c.point_a = c.point_b + (c.radius_b + c.gap) * c.normal;
    }
}

void tidy_mesh_points(ContactList& contacts, std::size_t begin) {
    drop_repeated(contacts, begin);
    thin_out(contacts, begin, kMostOfMesh);
}

void mesh_on_plane(ContactList& contacts, DetectStats& stats, const Part& a, const Part& b) {
    const bool plane_first = a.shape.kind == ShapeKind::plane;
    const Part &plane = plane_first ? a : b, &mesh = plane_first ? b : a;
    const Vec3 up = plane.world.axis[1];
    const double margin = pair_margin(a, b);
    const std::size_t begin = contacts.size();
    for (std::uint32_t i = 0; i < mesh.shape.vertex_count; ++i) {
        const Vec3 p = to_outer(mesh.world, mesh.shape.vertices[i]);
        const double gap = dot(up, p - plane.world.origin);
        if (!(gap <= margin)) continue;
        const Vec3 foot = p - gap * up;
        Contact& c = contacts.add(a, b);
        c.point_a = plane_first ? foot : p;
        c.point_b = plane_first ? p : foot;
        c.normal = plane_first ? -up : up;
        c.gap = gap;
        c.flags = kContactExact;
        c.feature = feature_key({5, i, a.index, b.index});
    }
    tidy_mesh_points(contacts, begin);
    stats.from_clip += contacts.size() - begin;
}

}  // namespace plumb
