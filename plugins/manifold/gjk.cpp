// SPDX-License-Identifier: MIT
/// The simplex holds up to four points w = a − b of the difference of the cores; v is its point
/// nearest to the origin, found by trying all sub-simplices with the vertex that came last (at most
/// eight small linear systems, exact for each): the others were tried before it came.
#include "manifold/gjk.h"

#include "manifold/support.h"

namespace plumb {
namespace {

struct Vertex {
    Vec3 on_a, on_b, w;
};

struct Simplex {
    Vertex vertex[4];
    double weight[4];
    int count = 0;
};

/// Weights of the point nearest to the origin in the affine hull of the chosen vertices; false
/// unless all positive.
bool affine_weights(const Simplex& s, const int* chosen, int n, double* weight) {
    const Vec3 p = s.vertex[chosen[0]].w;
    if (n == 1) return weight[0] = 1, true;
    const Vec3 d = s.vertex[chosen[1]].w - p;
    if (n == 2) {
        const double dd = dot(d, d);
        if (dd <= 0) return false;
        weight[1] = -dot(p, d) / dd;
        weight[0] = 1 - weight[1];
        return weight[0] > 0 && weight[1] > 0;
    }
    const Vec3 e = s.vertex[chosen[2]].w - p;
    if (n == 3) {
        const Vec3 m = cross(d, e);
        const double mm = dot(m, m);
        if (mm <= 0) return false;
        weight[1] = dot(m, cross(e, p)) / mm;
        weight[2] = -dot(m, cross(d, p)) / mm;
        weight[0] = 1 - weight[1] - weight[2];
        return weight[0] > 0 && weight[1] > 0 && weight[2] > 0;
    }
    const Vec3 f = s.vertex[chosen[3]].w - p;
    const double det = dot(d, cross(e, f));
    if (det == 0) return false;
    weight[1] = -dot(p, cross(e, f)) / det;
    weight[2] = -dot(d, cross(p, f)) / det;
    weight[3] = -dot(d, cross(e, p)) / det;
    weight[0] = 1 - weight[1] - weight[2] - weight[3];
    return weight[0] > 0 && weight[1] > 0 && weight[2] > 0 && weight[3] > 0;
}

/// Whether the last vertex leads nearer to the origin than v, the nearest point of the others. Then
/// v is moved there, and the simplex shrinks to the vertices that carry it; else it loses that one.
bool come_nearer(Simplex& s, Vec3& v) {
    const unsigned last = 1u << (s.count - 1);
    Vec3 best = v;
    double best_squared = dot(v, v), best_weight[4];
    int best_chosen[4], best_count = 0;
    for (unsigned subset = last; subset < 2 * last; ++subset) {
        int chosen[4], n = 0;
        for (int i = 0; i < s.count; ++i)
            if (subset & (1u << i)) chosen[n++] = i;
        double weight[4];
        if (!affine_weights(s, chosen, n, weight)) continue;
        Vec3 point{};
        for (int i = 0; i < n; ++i) point = point + weight[i] * s.vertex[chosen[i]].w;
        if (!(dot(point, point) < best_squared)) continue;
        best = point, best_squared = dot(point, point), best_count = n;
        std::copy(chosen, chosen + n, best_chosen);
        std::copy(weight, weight + n, best_weight);
    }
    if (best_count == 0) return --s.count, false;
    for (int i = 0; i < best_count; ++i) {
        s.vertex[i] = s.vertex[best_chosen[i]];  // none comes from before its place
        s.weight[i] = best_weight[i];
    }
    s.count = best_count;
    v = best;
    return true;
}

Vec3 middle(const Part& part) {
    return to_outer(part.world, 0.5 * (part.own_bounds.low + part.own_bounds.high));
}

/// How the parts are changed before they are asked about, and which way is asked first.
struct Change {
    double scale = 1;  ///< of both, about their middles
    Vec3 shift{};      ///< of a [m]
    Vec3 way{};        ///< where the search begins; zero: from middle to middle
};

Vertex support(const Part& a, const Part& b, Vec3 d, const Change& change) {
    Vec3 p = core_support(a, -d), q = core_support(b, d);
    if (change.scale != 1) {
        p = middle(a) + change.scale * (p - middle(a));
        q = middle(b) + change.scale * (q - middle(b));
    }
    p = p + change.shift;
    return {p, q, p - q};
}

/// The shortest difference so far, and the points that it joins.
struct Shortest {
    Vec3 v, on_a, on_b;
    double size;  ///< of both parts [m]

    /// Whether v is the shortest: a support in its direction leads no further.
    bool is_found(const Vertex& support) const {
        const double vv = dot(v, v);
        return vv - dot(v, support.w) <= 1e-12 * vv + 1e-16 * size * std::sqrt(vv);
    }
};

constexpr int kPolishSteps = 16;

/// Weights lose a simplex's last digits where its vertices are far apart or nearly one; steps
/// towards single supports (Frank and Wolfe) win them back. A flat side or a rim is as long a
/// lever, and what is lost as an angle is a gap.
void polish(Shortest& s, const Part& a, const Part& b, const Change& change) {
    for (int i = 0; i < kPolishSteps; ++i) {
        const Vertex next = support(a, b, s.v, change);
        if (s.is_found(next)) return;
        const Vec3 way = next.w - s.v;
        const double t = std::min(1.0, -dot(s.v, way) / dot(way, way));
        s.v = s.v + t * way;
        s.on_a = s.on_a + t * (next.on_a - s.on_a);
        s.on_b = s.on_b + t * (next.on_b - s.on_b);
    }
}

bool closest(Witness& witness, const Part& a, const Part& b, const Change& change) {
    const double size = size_of(a) + size_of(b), tiny = 1e-9 * size;
    Simplex s;
    Vec3 v = dot(change.way, change.way) > 0 ? change.way : middle(a) - middle(b);
    if (dot(v, v) < tiny * tiny) v = {0, 1, 0};
    s.vertex[0] = support(a, b, v, change);
    s.weight[0] = 1, s.count = 1;
    v = s.vertex[0].w;
    for (int i = 0; i < 64; ++i) {
        const double vv = dot(v, v);
        if (vv < tiny * tiny) return false;
        const Vertex next = support(a, b, v, change);
        if (Shortest{v, {}, {}, size}.is_found(next)) break;
        if (s.count == 4) return false;
        s.vertex[s.count++] = next;
        if (!come_nearer(s, v)) break;
    }
    Shortest found{v, {}, {}, size};
    for (int i = 0; i < s.count; ++i) {
        found.on_a = found.on_a + s.weight[i] * s.vertex[i].on_a;
        found.on_b = found.on_b + s.weight[i] * s.vertex[i].on_b;
    }
    polish(found, a, b, change);
    const double distance = norm(found.v);
    if (!(distance > tiny)) return false;
    witness.normal = (1 / distance) * found.v;
    witness.gap = distance - core_radius(a) - core_radius(b);
    witness.point = 0.5 * (found.on_a - core_radius(a) * witness.normal + found.on_b +
                           core_radius(b) * witness.normal);
    witness.approximate = false;
    return true;
}

/// How far a is drawn away before its normal is looked for, as a share of both sizes.
constexpr double kDrawn = 1e-3;
constexpr int kMostDrawings = 8;
/// Overlap that says that a normal is the right one, as a share of both sizes.
constexpr double kSlight = 1e-5;
/// Turned by less, a normal is as straight as rounding lets closest points tell [rad].
constexpr double kStraight = 1e-6;

/// plumb::straighten, with a drawn away until it is `drawn` [m] apart.
bool straighten(Vec3& normal, const Part& a, const Part& b, double drawn) {
    Vec3 n = normal;
    for (int i = 0; i < kMostDrawings; ++i) {
        const double apart = std::max(0.0, drawn - support_gap(a, b, n));
        Witness witness;
        if (!closest(witness, a, b, {1, apart * n, n})) return false;
        const double turned = norm(witness.normal - n);
        n = witness.normal;
        if (turned > kStraight) continue;
        normal = n;
        return true;
    }
    return false;
}

}  // namespace

bool closest_when_apart(Witness& witness, const Part& a, const Part& b, Vec3 way) {
    return closest(witness, a, b, {1, {}, way});
}

bool straighten(Vec3& normal, const Part& a, const Part& b) {
    return straighten(normal, a, b, kDrawn * (size_of(a) + size_of(b)));
}

bool closest_when_touching(Witness& witness, const Part& a, const Part& b) {
    if (!closest(witness, a, b, {0.98, {}, {}})) return false;
    witness.gap = support_gap(a, b, witness.normal);
    if (witness.gap > -kSlight * (size_of(a) + size_of(b))) return true;
    // what is long loses more at its ends than a small part overlaps it there
    Vec3 n = witness.normal;
    if (!straighten(n, a, b, -witness.gap)) return true;
    const double gap = support_gap(a, b, n);
    if (gap > witness.gap) witness.normal = n, witness.gap = gap;
    return true;
}

bool touching_point(Vec3& point, const Part& a, const Part& b, Vec3 n, double gap) {
    const double apart = std::max(0.0, 0.01 * (size_of(a) + size_of(b)) - gap);
    Witness witness;
    if (!closest(witness, a, b, {1, apart * n, {}})) return false;
    point = witness.point - 0.5 * apart * n;
    return true;
}

}  // namespace plumb
