// SPDX-License-Identifier: MIT
#include "manifold/mesh_topology.h"

#include <tuple>

namespace plumb {
namespace {

/// One side of an edge: the facet that has it, and as its which edge.
struct Side {
    std::uint32_t low, high;  ///< vertices
    std::uint32_t facet, edge;
    bool forward;  ///< the facet runs from low to high
    bool same_edge(const Side& o) const { return low == o.low && high == o.high; }
};

std::vector<Side> sorted_sides(const MeshTopology& t) {
    std::vector<Side> sides;
    sides.reserve(3 * t.facets.size());
    for (std::uint32_t f = 0; f < t.facets.size(); ++f)
        for (std::uint32_t e = 0; e < 3; ++e) {
            const std::uint32_t p = t.facets[f].corner[e], q = t.facets[f].corner[(e + 1) % 3];
            sides.push_back({std::min(p, q), std::max(p, q), f, e, p < q});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
        return std::tie(p.low, p.high, p.facet, p.edge) < std::tie(q.low, q.high, q.facet, q.edge);
    });
    return sides;
}

/// How the surface bends where `other` goes on behind an edge of `f`.
EdgeKind kind_of(const MeshTopology& t, const Facet& f, const Facet& other, std::uint32_t edge) {
    const Vec3 p = t.vertices[f.corner[edge]], q = t.vertices[f.corner[(edge + 1) % 3]];
    const double bend = dot(cross(f.normal, other.normal), unit_or(q - p, {0, 0, 0}));
    if (std::abs(bend) < kFlat && dot(f.normal, other.normal) > 0) return EdgeKind::flat;
    return bend > 0 ? EdgeKind::convex : EdgeKind::concave;
}

void join(MeshTopology& t, const Side& p, const Side& q) {
    if (p.forward == q.forward || p.facet == q.facet) return;
    Facet &f = t.facets[p.facet], &g = t.facets[q.facet];
    f.across[p.edge] = q.facet;
    g.across[q.edge] = p.facet;
    f.edge[p.edge] = g.edge[q.edge] = kind_of(t, f, g, p.edge);
}

/// Lists each vertex's neighbours; `sides` are sorted, so each edge stands in one run.
void make_rings(MeshTopology& t, const std::vector<Side>& sides, std::size_t vertices) {
    t.ring_begin.assign(vertices + 1, 0);
    const auto each_edge = [&](auto&& act) {
        for (std::size_t i = 0; i < sides.size(); ++i)
            if (i == 0 || !sides[i].same_edge(sides[i - 1])) act(sides[i].low, sides[i].high);
    };
    each_edge([&](std::uint32_t p, std::uint32_t q) {
        ++t.ring_begin[p + 1];
        ++t.ring_begin[q + 1];
    });
    for (std::size_t i = 1; i < t.ring_begin.size(); ++i) t.ring_begin[i] += t.ring_begin[i - 1];
    t.ring.resize(t.ring_begin.back());
    std::vector<std::uint32_t> end(t.ring_begin.begin(), t.ring_begin.end() - 1);
    each_edge([&](std::uint32_t p, std::uint32_t q) {
        t.ring[end[p]++] = q;
        t.ring[end[q]++] = p;
    });
}

}  // namespace

void MeshTopology::add(const std::uint32_t (&corner)[3], std::uint32_t id, Vec3 normal) {
    facets.push_back({{corner[0], corner[1], corner[2]},
                      {kNoFacet, kNoFacet, kNoFacet},
                      id,
                      {EdgeKind::open, EdgeKind::open, EdgeKind::open},
                      normal});
}

void MeshTopology::connect(const std::vector<Vec3>& all) {
    vertices = all.data();
    const std::vector<Side> sides = sorted_sides(*this);
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].same_edge(sides[i])) ++end;
        if (end - i == 2) join(*this, sides[i], sides[i + 1]);
        i = end;
    }
    make_rings(*this, sides, all.size());
    facet_of.assign(all.size(), kNoFacet);
    for (std::size_t f = facets.size(); f-- > 0;)
        for (const std::uint32_t k : facets[f].corner) facet_of[k] = static_cast<std::uint32_t>(f);
}

}  // namespace plumb
