// SPDX-License-Identifier: MIT
#include "manifold/mesh_pair.h"

#include "manifold/mesh_points.h"
#include "manifold/mesh_reduce.h"
#include "manifold/mesh_shift.h"
#include "manifold/mesh_side.h"

namespace plumb {
namespace {

constexpr double kParallel = 1e-3;  ///< sine within which two edges do not cross
constexpr double kLean = 0.03;      ///< sine by which faces that lie on each other may lean
constexpr double kOnePlane = 1e-3;  ///< angle within which two faces lie on each other [rad]
constexpr double kBeside = 0.02;    ///< sine by which a normal may leave the arc of an edge

Aabb grown(Aabb box, double by) {
    return {box.low - Vec3{by, by, by}, box.high + Vec3{by, by, by}};
}

/// An edge and the outward directions that it may be pushed along: from n1 to n2, about `along`.
struct Edge {
    std::uint32_t low, high;  ///< vertices
    Vec3 from, along;         ///< world frame, along is not unit [m]
    Vec3 n1, n2;

    bool allows(Vec3 n) const {
        const double least = -kBeside * norm(along);
        return dot(n, n1 + n2) > 0 && dot(cross(n1, n), along) > least &&
               dot(cross(n, n2), along) > least;
    }
};

/// The e-th edge of a facet; false where it cannot touch.
bool sharp_edge(Edge& edge, const MeshSide& mesh, std::uint32_t f, std::uint32_t e) {
    const Facet& facet = mesh.facet(f);
    const EdgeKind kind = facet.edge[e];
    if (kind != EdgeKind::open && kind != EdgeKind::convex) return false;
    edge.low = facet.corner[e], edge.high = facet.corner[(e + 1) % 3];
    edge.from = mesh.vertex(edge.low);
    edge.along = mesh.vertex(edge.high) - edge.from;
    edge.n1 = mesh.normal(f);
    edge.n2 = kind == EdgeKind::convex ? mesh.normal(facet.across[e])
                                       : cross(unit_or(edge.along, {0, 0, 0}), edge.n1);
    return dot(edge.n1, edge.n1) > 0.5;
}

/// Two facets that are near each other.
struct NearPair {
    std::uint32_t body, ground;
};

/// Adds contacts of one mesh, the body, with the other, the ground.
class Contacts {
public:
    Contacts(ContactList& out, const MeshSide& body, const MeshSide& ground, bool body_is_a)
        : out_(out),
          body_(body),
          ground_(ground),
          body_is_a_(body_is_a),
          margin_(pair_margin(body.part(), ground.part())) {}

    void vertex_over_face(std::uint32_t vertex, Vec3 p, std::uint32_t f) {
        const Facet& facet = ground_.facet(f);
        const Vec3 n = ground_.normal(f);
        const double height = dot(n, p - ground_.vertex(facet.corner[0]));
        if (dot(n, n) < 0.5 || height > margin_ || !is_over(facet, n, p)) return;
        if (!body_.sticks_out(vertex, -n, kLean)) return;
        const Vec3 foot = p - height * n;
        if (!is_way_out(p, foot, n, -height)) return;
        add(p, foot, n, height, {6, vertex, facet.id}, body_.topology().facet_of[vertex], facet.id);
    }

    /// A vertex and the point of the surface that is nearest to it, outside.
    void vertex_apart(std::uint32_t vertex, Vec3 p, const NearestPoint& near) {
        const Frame& frame = ground_.part().world;
        const double distance = std::sqrt(near.squared);
        if (distance <= ground_.slack() || distance > margin_) return;
        const Vec3 foot = to_outer(frame, near.point), n = (1 / distance) * (p - foot);
        if (dot(n, rotated(frame, near.pseudonormal)) <= 0) return;
        if (!body_.sticks_out(vertex, -n, kFlat)) return;
        add(p, foot, n, distance, {7, vertex, near.triangle}, body_.topology().facet_of[vertex],
            near.triangle);
    }

    void edge_across_edge(const Edge& mine, const Edge& its, const NearPair& facets) {
        const Vec3 across = cross(mine.along, its.along);
        const double length = norm(across);
        if (length < kParallel * norm(mine.along) * norm(its.along)) return;
        const Vec3 apart = its.from - mine.from, m = (1 / length) * across;
        const double s = dot(cross(apart, its.along), m) / length;
        const double t = dot(cross(apart, mine.along), m) / length;
        if (s < -1e-9 || s > 1 + 1e-9 || t < -1e-9 || t > 1 + 1e-9) return;
        const Vec3 n = dot(m, its.n1 + its.n2) < 0 ? -m : m;
        if (!its.allows(n) || !mine.allows(-n)) return;
        const Vec3 p = mine.from + s * mine.along, q = its.from + t * its.along;
        const double gap = dot(n, p - q);
        if (gap > margin_ || !is_way_out(p, q, n, -gap)) return;
        add(p, q, n, gap, {8, mine.low, mine.high, its.low, its.high}, facets.body,
            ground_.facet(facets.ground).id);
    }

private:
    /// Whether a point stands over a facet, its border included.
    bool is_over(const Facet& facet, Vec3 n, Vec3 p) const {
        for (int k = 0; k < 3; ++k) {
            const Vec3 q = ground_.vertex(facet.corner[k]);
            const Vec3 d = ground_.vertex(facet.corner[(k + 1) % 3]) - q;
            if (dot(n, cross(d, p - q)) < -10 * ground_.slack() * norm(d)) return false;
        }
        return true;
    }

    /// Whether the body may be pushed out of the ground from `on_body` to `on_ground`, with nothing
    /// of either between.
    bool is_way_out(Vec3 on_body, Vec3 on_ground, Vec3 n, double depth) const {
        return depth <= 0 ||
               (ground_.is_free(on_body, n, depth) && body_.is_free(on_ground, -n, depth));
    }

    void add(Vec3 on_body, Vec3 on_ground, Vec3 n, double gap,
             std::initializer_list<std::uint64_t> key, std::uint32_t body_facet,
             std::uint32_t ground_triangle) {
        const Part &p = body_.part(), &q = ground_.part();
        Contact& c = body_is_a_ ? out_.add(p, q) : out_.add(q, p);
        c.point_a = body_is_a_ ? on_body : on_ground;
        c.point_b = body_is_a_ ? on_ground : on_body;
        c.normal = body_is_a_ ? n : -n;
        c.gap = gap;
        c.flags = kContactExact;
        c.feature = feature_key({feature_key(key), body_is_a_, p.index, q.index});
        if (p.index == 0) (body_is_a_ ? c.part_a : c.part_b) = body_.facet(body_facet).id;
        if (q.index == 0) (body_is_a_ ? c.part_b : c.part_a) = ground_triangle;
        c.reserved = body_is_a_ ? 0 : kBodyIsB;
    }

    ContactList& out_;
    const MeshSide &body_, &ground_;
    const bool body_is_a_;
    const double margin_;
};

/// Vertices of the body that lie inside the ground, or near it, each with the ground's nearest
/// point: from the facets that are near the ground inwards, as far as the inside reaches.
class Sunken {
public:
    struct Vertex {
        std::uint32_t index;
        Vec3 place;  ///< [m]
        NearestPoint near;
        bool inside;
    };

    void find(const MeshSide& body, const MeshSide& ground, const std::vector<std::uint32_t>& from,
              double margin) {
        found_.clear();
        depth_ = 0;
        seen_.assign(body.topology().facet_of.size(), 0);
        for (const std::uint32_t f : from)
            for (const std::uint32_t k : body.facet(f).corner) reach(k);
        while (!open_.empty()) {
            const std::uint32_t v = open_.back();
            open_.pop_back();
            const Vec3 p = body.vertex(v);
            const NearestPoint near = ground.nearest(p, 1e300);
            const bool inside = ground.holds(p, near);
            const double distance = std::sqrt(near.squared);
            if (inside || distance <= margin) found_.push_back({v, p, near, inside});
            if (!inside) continue;
            depth_ = std::max(depth_, distance);
            const MeshTopology& mesh = body.topology();
            for (std::uint32_t i = mesh.ring_begin[v]; i < mesh.ring_begin[v + 1]; ++i)
                reach(mesh.ring[i]);
        }
        std::sort(found_.begin(), found_.end(),
                  [](const Vertex& p, const Vertex& q) { return p.index < q.index; });
    }

    const std::vector<Vertex>& found() const { return found_; }
    double depth() const { return depth_; }

private:
    void reach(std::uint32_t v) {
        if (seen_[v]) return;
        seen_[v] = 1;
        open_.push_back(v);
    }

    std::vector<Vertex> found_;
    std::vector<std::uint32_t> open_;
    std::vector<std::uint8_t> seen_;
    double depth_ = 0;  ///< greatest distance of a vertex from the surface around it [m]
};

/// Memory of a thread, so that a pair allocates nothing.
struct Scratch {
    std::vector<NearPair> pairs;
    std::vector<std::uint32_t> of_a, of_b;  ///< facets, each once
    Sunken a_in_b, b_in_a;
};

/// All pairs of facets whose bounds come within the margin.
void find_pairs(Scratch& s, const MeshSide& a, const MeshSide& b, double margin) {
    s.pairs.clear(), s.of_a.clear(), s.of_b.clear();
    const Frame &from = a.part().world, &to = b.part().world;
    const Surface& surface = *b.part().surface;
    const Aabb region = grown(box_between(from, to, a.part().own_bounds), margin);
    b.overlapping(region, [&](std::uint32_t g) {
        const Aabb box = box_between(to, from, grown(surface.box_of(g), margin));
        a.overlapping(box, [&](std::uint32_t f) { s.pairs.push_back({f, g}); });
    });
    for (const NearPair& p : s.pairs) s.of_a.push_back(p.body), s.of_b.push_back(p.ground);
    for (auto* facets : {&s.of_a, &s.of_b}) {
        std::sort(facets->begin(), facets->end());
        facets->erase(std::unique(facets->begin(), facets->end()), facets->end());
    }
}

void add_edges(ContactList& out, const Scratch& s, const MeshSide& a, const MeshSide& b) {
    Contacts contacts(out, a, b, true);
    for (const NearPair& pair : s.pairs)
        for (std::uint32_t i = 0; i < 3; ++i) {
            Edge mine, its;
            if (!sharp_edge(mine, a, pair.body, i)) continue;
            for (std::uint32_t k = 0; k < 3; ++k)
                if (sharp_edge(its, b, pair.ground, k)) contacts.edge_across_edge(mine, its, pair);
        }
}

/// Vertices of the body on the ground, none deeper than `most`, thinned out face by face.
void add_vertices(ContactList& out, const Sunken& sunken, const MeshSide& body,
                  const MeshSide& ground, bool body_is_a, double most) {
    const std::size_t begin = out.size();
    Contacts contacts(out, body, ground, body_is_a);
    for (const Sunken::Vertex& v : sunken.found()) {
        const Vec3 p = to_inner(ground.part().world, v.place);
        ground.overlapping(grown({p, p}, most), [&](std::uint32_t f) {
            contacts.vertex_over_face(v.index, v.place, f);
        });
        if (!v.inside) contacts.vertex_apart(v.index, v.place, v.near);
    }
    reduce_by_planes(out, begin, !body_is_a);
}

double deepest_of(const ContactList& list, std::size_t begin) {
    double depth = 0;
    for (auto c = list.begin() + static_cast<std::ptrdiff_t>(begin); c != list.end(); ++c)
        depth = std::max(depth, -c->gap);
    return depth;
}

}  // namespace

void collide_meshes(ContactList& out, DetectStats& stats, const Part& a, const Part& b) {
    static thread_local Scratch s;
    const MeshSide side_a(a), side_b(b);
    const double margin = pair_margin(a, b);
    find_pairs(s, side_a, side_b, margin);
    if (s.pairs.empty()) return;

    const std::size_t begin = out.size();
    add_edges(out, s, side_a, side_b);
    s.a_in_b.find(side_a, side_b, s.of_a, margin);
    s.b_in_a.find(side_b, side_a, s.of_b, margin);
    const double depth = std::max({deepest_of(out, begin), s.a_in_b.depth(), s.b_in_a.depth()});
    const double most = 2 * depth + margin + side_a.slack() + side_b.slack();
    add_vertices(out, s.a_in_b, side_a, side_b, true, most);
    add_vertices(out, s.b_in_a, side_b, side_a, false, most);

    // Faces that nearly lie on each other give one plane, whosever the normal.
    reduce_by_planes(out, begin, false, kOnePlane);
    keep_shortest_ways(out, begin, side_a, side_b);
    tidy_mesh_points(out, begin);
    for (std::size_t i = begin; i < out.size(); ++i) out.data()[i].reserved = 0;
    stats.from_clip += out.size() - begin;
    stats.shared_normals += out.size() - begin;
}

}  // namespace plumb
