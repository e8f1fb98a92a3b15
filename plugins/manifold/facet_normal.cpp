// SPDX-License-Identifier: MIT
#include "manifold/facet_normal.h"

namespace plumb {
namespace {

constexpr double kSame = 2e-4;     ///< angle within which two directions are one [rad]
constexpr double kNearest = 1e-3;  ///< by which a normal may lie beyond the far face [rad]

bool within(Vec3 m, Vec3 n, double angle) { return dot(m, n) > 1 - 0.5 * angle * angle; }

/// Whether no neighbour of a vertex stands higher along m than the vertex itself.
bool sticks_out(const MeshTopology& mesh, std::uint32_t vertex, Vec3 m) {
    const Vec3 p = mesh.vertices[vertex];
    for (std::uint32_t i = mesh.ring_begin[vertex]; i < mesh.ring_begin[vertex + 1]; ++i) {
        const Vec3 d = mesh.vertices[mesh.ring[i]] - p;
        if (dot(d, m) > kFlat * norm(d)) return false;
    }
    return true;
}

bool may_catch(EdgeKind kind) { return kind == EdgeKind::open || kind == EdgeKind::convex; }

FacetNormal at_edge(const MeshTopology& mesh, const Facet& f, int e, Vec3 m) {
    if (!may_catch(f.edge[e])) return {f.normal, true};
    const Vec3 p = mesh.vertices[f.corner[e]], q = mesh.vertices[f.corner[(e + 1) % 3]];
    const Vec3 along = unit_or(q - p, {0, 0, 0});
    const Vec3 across = unit_or(m - dot(m, along) * along, f.normal);
    if (f.edge[e] == EdgeKind::open)
        return dot(m, f.normal) > 0 ? FacetNormal{across, false} : FacetNormal{f.normal, true};

    // Between the two faces' normals: not past the far one, seen from this one.
    const Vec3 far = mesh.facets[f.across[e]].normal;
    if (within(m, far, kSame)) return {far, false};
    if (dot(cross(far, across), along) > 0) return {far, !within(m, far, kNearest)};
    return {across, false};
}

FacetNormal at_corner(const MeshTopology& mesh, const Facet& f, int i, Vec3 m) {
    const bool free = may_catch(f.edge[i]) || may_catch(f.edge[(i + 2) % 3]);
    if (free && sticks_out(mesh, f.corner[i], m)) return {m, false};
    // A body that lies on the far face of a convex edge may name a corner of it.
    for (const int e : {i, (i + 2) % 3}) {
        if (f.edge[e] != EdgeKind::convex) continue;
        const Vec3 far = mesh.facets[f.across[e]].normal;
        if (dot(m, far) > dot(m, f.normal) && dot(m, far) > 0.9) return {far, true};
    }
    return {f.normal, true};
}

}  // namespace

FacetNormal allowed_normal(const MeshTopology& mesh, const Facet& f, Vec3 m) {
    if (within(m, f.normal, kSame)) return {f.normal, false};
    Vec3 p[3];
    double height[3];
    for (int i = 0; i < 3; ++i) {
        p[i] = mesh.vertices[f.corner[i]];
        height[i] = dot(m, p[i]);
    }
    const int top = height[0] >= height[1] && height[0] >= height[2] ? 0
                    : height[1] >= height[2]                         ? 1
                                                                     : 2;
    // What is touched: the highest corner along m, and the next one where it is as high.
    const int after = (top + 1) % 3, before = (top + 2) % 3;
    const auto level = [&](int i) {
        return height[top] - height[i] <= kFlat * norm(p[top] - p[i]);
    };
    if (level(after)) return at_edge(mesh, f, top, m);
    if (level(before)) return at_edge(mesh, f, before, m);
    return at_corner(mesh, f, top, m);
}

}  // namespace plumb
