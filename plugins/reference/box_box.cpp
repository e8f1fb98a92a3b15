// SPDX-License-Identifier: MIT
/// Box against box: fifteen separating axes, then the two faces that look at each other.
///
/// Overlapping boxes take the axis of least overlap, exactly. Separated boxes take the axis of the
/// widest gap where that gap is reached by two points, and else the closest points of the two boxes
/// (vertex or edge against edge or vertex), found by trying all features. Points come from cutting
/// x's face by the prism over y's face along n; the gap of each is its height over y's face,
/// measured along n.
#include "reference/narrow.h"

namespace plumb::reference {
namespace {

/// A unit direction out of y towards x, and how far the boxes are apart along it [m].
struct Axis {
    Vec3 n;
    double gap;
};

double extent(const Box& box, Vec3 n) {
    return box.half[0] * std::abs(dot(box.axis[0], n)) +
           box.half[1] * std::abs(dot(box.axis[1], n)) +
           box.half[2] * std::abs(dot(box.axis[2], n));
}

Axis widest_gap(const Box& x, const Box& y, double margin) {
    const Vec3 d = x.centre - y.centre;
    Axis best{{0, 1, 0}, -1e300};
    const auto try_axis = [&](Vec3 n, double advantage) {
        const double along = dot(d, n);
        const double gap = std::abs(along) - extent(x, n) - extent(y, n);
        if (gap > best.gap + advantage) best = {along >= 0 ? n : -n, gap};
        return gap <= margin;
    };
    // Faces win over edges where both are as good: their points are steadier.
    const double tie = 1e-7 * (x.half[0] + x.half[1] + x.half[2]);
    for (int i = 0; i < 3; ++i)
        if (!try_axis(x.axis[i], tie)) return best;
    for (int i = 0; i < 3; ++i)
        if (!try_axis(y.axis[i], tie)) return best;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const Vec3 m = cross(x.axis[i], y.axis[j]);
            const double length = norm(m);
            if (length > 1e-6 && !try_axis((1 / length) * m, tie)) return best;
        }
    return best;
}

struct Face {
    Vec3 corner[4];  ///< counter-clockwise seen from outside [m]
    Vec3 normal;
    unsigned id;
};

Face face_towards(const Box& box, Vec3 d) {
    int k = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(dot(box.axis[i], d)) > std::abs(dot(box.axis[k], d)) + 1e-9) k = i;
    const double side = dot(box.axis[k], d) >= 0 ? 1 : -1;
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const Vec3 eu = box.half[u] * box.axis[u], ev = side * box.half[v] * box.axis[v];
    const Vec3 c = box.centre + side * box.half[k] * box.axis[k];
    return {{c + eu + ev, c - eu + ev, c - eu - ev, c + eu - ev},
            side * box.axis[k],
            2 * static_cast<unsigned>(k) + (side > 0)};
}

/// A polygon whose corners remember which line leaves them: an edge of x's face (0…3) or a side of
/// the prism (4…7).
struct Cut {
    static constexpr int kMost = 12;
    Vec3 corner[kMost];
    unsigned line[kMost];
    int count = 0;
    void add(Vec3 p, unsigned l) {
        if (count < kMost) corner[count] = p, line[count++] = l;
    }
};

/// Keeps what lies on the inner side of the plane through `p` with inward unit normal `m`.
Cut cut_by(const Cut& in, Vec3 p, Vec3 m, unsigned line, double slack) {
    Cut out;
    for (int i = 0; i < in.count; ++i) {
        const int j = (i + 1) % in.count;
        const double di = dot(m, in.corner[i] - p), dj = dot(m, in.corner[j] - p);
        const bool inside_i = di >= -slack, inside_j = dj >= -slack;
        if (inside_i) out.add(in.corner[i], in.line[i]);
        if (inside_i == inside_j) continue;
        const Vec3 q = in.corner[i] + (di / (di - dj)) * (in.corner[j] - in.corner[i]);
        out.add(q, inside_i ? line : in.line[i]);
    }
    return out;
}

Cut face_in_prism(const Face& x, const Face& y, Vec3 n, double slack) {
    Cut cut;
    for (unsigned i = 0; i < 4; ++i) cut.add(x.corner[i], i);
    for (unsigned j = 0; j < 4 && cut.count; ++j) {
        const Vec3 edge = y.corner[(j + 1) % 4] - y.corner[j];
        cut = cut_by(cut, y.corner[j], unit_or(cross(n, edge), n), 4 + j, slack);
    }
    return cut;
}

/// Up to eight points along n, and whether the deepest of them is as deep as `gap`.
struct FacePoints {
    Vec3 on_x[Cut::kMost];
    double gap[Cut::kMost];
    std::uint64_t feature[Cut::kMost];
    int count = 0;
    double deepest = 1e300;
};

FacePoints face_points(const Box& x, const Box& y, Vec3 n) {
    const Face fx = face_towards(x, -n), fy = face_towards(y, n);
    const Cut cut = face_in_prism(fx, fy, n, 1e-9 * (x.half[0] + x.half[1] + x.half[2]));
    FacePoints r;
    for (int i = 0; i < cut.count; ++i) {
        const unsigned before = cut.line[(i + cut.count - 1) % cut.count];
        r.on_x[r.count] = cut.corner[i];
        r.gap[r.count] = dot(fy.normal, cut.corner[i] - fy.corner[0]) / dot(fy.normal, n);
        r.feature[r.count] = feature_key({fx.id, fy.id, before, cut.line[i]});
        r.deepest = std::min(r.deepest, r.gap[r.count++]);
    }
    return r;
}

Vec3 nearest_in(const Box& box, Vec3 p) {
    Vec3 q = box.centre;
    for (int i = 0; i < 3; ++i) {
        const double t = dot(p - box.centre, box.axis[i]);
        q = q + std::min(box.half[i], std::max(-box.half[i], t)) * box.axis[i];
    }
    return q;
}

Vec3 vertex(const Box& box, int i) {
    return box.centre + (i & 1 ? 1 : -1) * box.half[0] * box.axis[0] +
           (i & 2 ? 1 : -1) * box.half[1] * box.axis[1] +
           (i & 4 ? 1 : -1) * box.half[2] * box.axis[2];
}

/// The i-th edge of twelve: parallel to axis i / 4.
Segment edge(const Box& box, int i) {
    const int k = i / 4, u = (k + 1) % 3, v = (k + 2) % 3;
    const Vec3 middle = box.centre + (i & 1 ? 1 : -1) * box.half[u] * box.axis[u] +
                        (i & 2 ? 1 : -1) * box.half[v] * box.axis[v];
    return {middle - box.half[k] * box.axis[k], middle + box.half[k] * box.axis[k]};
}

/// Closest points of two boxes that are apart: every vertex with the other box, every edge with
/// every edge.
struct Closest {
    Vec3 on_x, on_y;
    double squared = 1e300;  ///< distance² [m²]
    std::uint64_t feature = 0;
    void offer(Vec3 p, Vec3 q, std::uint64_t id) {
        const double d = dot(p - q, p - q);
        if (d < squared - 1e-14) on_x = p, on_y = q, squared = d, feature = id;
    }
};

Closest closest_points(const Box& x, const Box& y) {
    Closest best;
    for (int i = 0; i < 8; ++i) {
        const Vec3 p = vertex(x, i), q = vertex(y, i);
        best.offer(p, nearest_in(y, p), 1000u + static_cast<unsigned>(i));
        best.offer(nearest_in(x, q), q, 1010u + static_cast<unsigned>(i));
    }
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) {
            const Segment a = edge(x, i), b = edge(y, j);
            const SegmentPair s = closest_of_segments(a.from, a.to - a.from, b.from, b.to - b.from);
            best.offer(a.from + s.s * (a.to - a.from), b.from + s.t * (b.to - b.from),
                       1020u + static_cast<unsigned>(12 * i + j));
        }
    return best;
}

/// One point where the faces gave none that is deep enough: the supports' middle, moved onto both
/// supports.
void support_point(const Emitter& e, const Box& x, const Box& y, const Axis& axis) {
    Vec3 low = x.centre, high = y.centre;
    for (int i = 0; i < 3; ++i) {
        low = low - (dot(x.axis[i], axis.n) >= 0 ? 1 : -1) * x.half[i] * x.axis[i];
        high = high + (dot(y.axis[i], axis.n) >= 0 ? 1 : -1) * y.half[i] * y.axis[i];
    }
    const Vec3 middle = 0.5 * (low + high);
    e.point(middle + dot(axis.n, low - middle) * axis.n,
            middle + dot(axis.n, high - middle) * axis.n, axis.n, 0, 0, 999);
}

void emit(const Emitter& e, const FacePoints& points, Vec3 n) {
    for (int i = 0; i < points.count; ++i)
        e.point(points.on_x[i], points.on_x[i] - points.gap[i] * n, n, 0, 0, points.feature[i]);
}

}  // namespace

void box_box(const Emitter& e) {
    const Box x = box_of(e.x), y = box_of(e.y);
    const Axis axis = widest_gap(x, y, e.margin);
    if (axis.gap > e.margin) return;
    const double tolerance = 1e-7 * (x.half[0] + x.half[1] + x.half[2]);

    // The gap along the axis is the true one where two points reach it.
    const FacePoints points = face_points(x, y, axis.n);
    if (points.deepest <= axis.gap + tolerance) return emit(e, points, axis.n);
    if (axis.gap <= 0) {
        support_point(e, x, y, axis);
        return emit(e, points, axis.n);
    }
    const Closest closest = closest_points(x, y);
    const double distance = std::sqrt(closest.squared);
    if (distance > e.margin) return;
    const Vec3 n = unit_or(closest.on_x - closest.on_y, axis.n);
    e.point(closest.on_x, closest.on_y, n, 0, 0, closest.feature);
    const FacePoints others = face_points(x, y, n);
    for (int i = 0; i < others.count; ++i)
        if (norm(others.on_x[i] - closest.on_x) > 1e-6)
            e.point(others.on_x[i], others.on_x[i] - others.gap[i] * n, n, 0, 0, others.feature[i]);
}

}  // namespace plumb::reference
