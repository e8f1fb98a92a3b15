// SPDX-License-Identifier: MIT
#include "manifold/sharpen.h"

#include "manifold/gjk.h"
#include "manifold/support.h"

namespace plumb {
namespace {

constexpr double kNear = 0.05;  ///< how far a direction may be off, as a sine

/// The directions of a face's edges that lie across the normal; parallel ones once.
struct Edges {
    static constexpr int kMost = 12;
    Vec3 way[kMost];
    int count = 0;

    Edges(const SupportFace& face, Vec3 n) {
        for (int i = 0; i + (face.count < 3) < face.count; ++i)
            add(unit_or(face.corner[(i + 1) % face.count] - face.corner[i], n), n);
    }

private:
    void add(Vec3 e, Vec3 n) {
        if (count == kMost || std::abs(dot(e, n)) > kNear) return;
        for (int i = 0; i < count; ++i)
            if (norm(cross(way[i], e)) < 1e-9) return;
        way[count++] = e;
    }
};

/// The best direction so far. The first of equals stays, so that faces go before edges.
class Search {
public:
    Search(const Part& a, const Part& b, Vec3 n)
        : a_(a), b_(b), n_(n), slack_(1e-9 * (size_of(a) + size_of(b))) {}

    /// Takes a direction that is better.
    void offer(Vec3 way) {
        const double length = norm(way);
        if (!(length > 1e-6)) return;
        const Vec3 m = (dot(way, n_) < 0 ? -1 / length : 1 / length) * way;
        if (norm(cross(m, n_)) > kNear) return;
        const double gap = support_gap(a_, b_, m);
        if (gap > gap_ + slack_) gap_ = gap, best_ = m;
    }
    Vec3 best() const { return best_; }

    /// The best, or another direction where that is better still.
    Vec3 better_of(Vec3 other) const { return support_gap(a_, b_, other) > gap_ ? other : best_; }

private:
    const Part &a_, &b_;
    Vec3 n_;
    double slack_;
    Vec3 best_ = n_;
    double gap_ = -1e300;
};

}  // namespace

bool is_bent(const Part& part) {
    return part.shape.kind == ShapeKind::cylinder || part.shape.kind == ShapeKind::cone;
}

void sharpen(Witness& witness, const Part& a, const Part& b) {
    if (!finite(witness.normal)) return;
    const Vec3 n = unit_or(witness.normal, {0, 1, 0});
    const SupportFace face_a = support_face(a, -n, {}, 0), face_b = support_face(b, n, {}, 0);
    Search search(a, b, n);
    search.offer(face_a.normal);
    search.offer(face_b.normal);

    const Edges edges_a(face_a, n), edges_b(face_b, n);
    if (is_bent(a) && is_bent(b)) {  // side by side: across both axes
        const Vec3 between = a.world.origin - b.world.origin;
        for (int i = 0; i < edges_a.count; ++i)
            search.offer(between - dot(between, edges_a.way[i]) * edges_a.way[i]);
    }
    for (int i = 0; i < edges_a.count; ++i)
        for (int j = 0; j < edges_b.count; ++j) search.offer(cross(edges_a.way[i], edges_b.way[j]));

    const bool bent = is_bent(a) || is_bent(b);
    Vec3 straight = search.better_of(n);
    if (bent && straighten(straight, a, b)) {
        search.offer(straight);
    } else {
        for (const Edges* edges : {&edges_a, &edges_b})
            for (int i = 0; i < edges->count; ++i)
                search.offer(n - dot(n, edges->way[i]) * edges->way[i]);
        Witness closest;
        if (closest_when_apart(closest, a, b, n)) search.offer(closest.normal);
    }
    search.offer(n);
    witness.normal = search.best();
}

}  // namespace plumb
