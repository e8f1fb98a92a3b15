// SPDX-License-Identifier: MIT
/// Box against capsule.
///
/// The normal comes from the closest points of box and core; where the core is inside, from the
/// exact separating axes of the two. Along the normal the box throws a shadow on the core: both
/// ends of that stretch touch, and so does the lowest point between them where it lies deeper. In
/// box coordinates:
///
///   p, d  start of the core and its whole length
///   n     normal, out of the box
///   h     half extents
#include "reference/narrow.h"

namespace plumb::reference {
namespace {

struct Core {
    Vec3 p, d;
};

Vec3 clamped(Vec3 p, Vec3 h) {
    for (int i = 0; i < 3; ++i) at(p, i) = std::min(at(h, i), std::max(-at(h, i), at(p, i)));
    return p;
}

/// Whether the core meets the box: three slabs.
bool meets(const Core& c, Vec3 h) {
    double low = 0, high = 1;
    for (int i = 0; i < 3; ++i) {
        const double p = at(c.p, i), d = at(c.d, i);
        if (std::abs(d) < 1e-15) {
            if (std::abs(p) > at(h, i)) return false;
            continue;
        }
        const double s = (-at(h, i) - p) / d, t = (at(h, i) - p) / d;
        low = std::max(low, std::min(s, t));
        high = std::min(high, std::max(s, t));
    }
    return low <= high;
}

/// Shortest vector from the box to a core that does not meet it: from an end, or from an edge of
/// the box.
Vec3 shortest_way(const Core& c, Vec3 h) {
    Vec3 best = c.p - clamped(c.p, h);
    const Vec3 end = c.p + c.d, other = end - clamped(end, h);
    if (dot(other, other) < dot(best, best)) best = other;
    for (int k = 0; k < 3; ++k)
        for (int corner = 0; corner < 4; ++corner) {
            Vec3 from{}, along{};
            at(from, k) = -at(h, k);
            at(from, (k + 1) % 3) = (corner & 1 ? 1 : -1) * at(h, (k + 1) % 3);
            at(from, (k + 2) % 3) = (corner & 2 ? 1 : -1) * at(h, (k + 2) % 3);
            at(along, k) = 2 * at(h, k);
            const SegmentPair s = closest_of_segments(c.p, c.d, from, along);
            const Vec3 way = c.p + s.s * c.d - (from + s.t * along);
            if (dot(way, way) < dot(best, best)) best = way;
        }
    return best;
}

double extent(Vec3 h, Vec3 n) {
    return h.x * std::abs(n.x) + h.y * std::abs(n.y) + h.z * std::abs(n.z);
}

/// Normal of least overlap for a core that meets the box.
Vec3 least_overlap(const Core& c, Vec3 h) {
    const Vec3 middle = c.p + 0.5 * c.d;
    Vec3 best{0, 1, 0};
    double best_gap = -1e300;
    const auto try_axis = [&](Vec3 n) {
        if (dot(middle, n) < 0) n = -n;
        const double gap = dot(middle, n) - extent(h, n) - 0.5 * std::abs(dot(c.d, n));
        if (gap > best_gap + 1e-9) best_gap = gap, best = n;
    };
    for (int k = 0; k < 3; ++k) {
        Vec3 axis{};
        at(axis, k) = 1;
        try_axis(axis);
    }
    for (int k = 0; k < 3; ++k) {
        Vec3 axis{};
        at(axis, k) = 1;
        const Vec3 n = cross(axis, c.d);
        if (norm(n) > 1e-6 * norm(c.d) && norm(n) > 1e-12) try_axis((1 / norm(n)) * n);
    }
    return best;
}

/// Names the box's face that looks most along n. Where a line leaves the box is no feature: at an
/// edge it may be either face.
int main_axis(Vec3 n) {
    const int k = std::abs(n.x) > std::abs(n.y) ? 0 : 1;
    return std::abs(n.z) > std::abs(at(n, k)) ? 2 : k;
}
unsigned facing(Vec3 n) {
    const int k = main_axis(n);
    return 2 * static_cast<unsigned>(k) + (at(n, k) > 0 ? 1 : 0);
}

/// How far the box reaches from `p` along n: where the line leaves it. Faces that n all but grazes
/// count as ending where the face across n does, which errs by 4e-6 of their height: else the end
/// of a core would stand beside the far edge of such a face.
double way_out(Vec3 p, Vec3 n, Vec3 h) {
    double best = 1e300;
    for (unsigned i = 0; i < 3; ++i) {
        const double ni = at(n, static_cast<int>(i));
        if (std::abs(ni) < 2e-3) continue;
        const double s =
            ((ni > 0 ? 1 : -1) * at(h, static_cast<int>(i)) - at(p, static_cast<int>(i))) / ni;
        best = std::min(best, s);
    }
    return best;
}

/// The stretch [low, high] of the core within the box's shadow along n, and what ends it.
struct Stretch {
    double low = 0, high = 1;
    unsigned low_end = 0, high_end = 1;
};

Stretch in_shadow(const Core& c, Vec3 n, Vec3 h) {
    Stretch r;
    // The axis nearest to n comes last: its edges make an outline of their own only at corners.
    for (int i = 1; i <= 3; ++i) {
        const int k = (main_axis(n) + i) % 3;
        // The shadow's outline runs along n × e_k; its width that way is the box's.
        Vec3 axis{};
        at(axis, k) = 1;
        const Vec3 m = cross(n, axis);
        if (norm(m) < 1e-6) continue;
        const double width = extent(h, m) + 1e-9 * norm(h), p = dot(c.p, m), d = dot(c.d, m);
        if (std::abs(d) < 1e-12) continue;
        const double s = ((d > 0 ? -width : width) - p) / d, t = ((d > 0 ? width : -width) - p) / d;
        const unsigned id = 2 + 4 * static_cast<unsigned>(k);
        if (s > r.low) r.low = s, r.low_end = id + (d > 0);
        if (t < r.high) r.high = t, r.high_end = id + 2 + (d > 0);
    }
    return r;
}

/// Where a convex function of the stretch is least: golden section.
template <class F>
double least_at(double low, double high, F f) {
    constexpr double kGolden = 0.6180339887498949;
    double s = high - kGolden * (high - low), t = low + kGolden * (high - low);
    double fs = f(s), ft = f(t);
    for (int i = 0; i < 80; ++i) {
        if (fs <= ft) {
            high = t, t = s, ft = fs;
            s = high - kGolden * (high - low), fs = f(s);
        } else {
            low = s, s = t, fs = ft;
            t = low + kGolden * (high - low), ft = f(t);
        }
    }
    return 0.5 * (low + high);
}

}  // namespace

void box_capsule(const Emitter& e) {
    const Vec3 h = e.x.shape.half_extents;
    const Segment core = core_of(e.y);
    const Core c{to_inner(e.x.world, core.from), turned_back(e.x.world, core.to - core.from)};

    // Normal out of the box towards the capsule.
    const Vec3 way = meets(c, h) ? Vec3{} : shortest_way(c, h);
    const bool apart = norm(way) > 1e-10;
    if (norm(way) - e.y.shape.radius > e.margin) return;
    const Vec3 n = apart ? (1 / norm(way)) * way : least_overlap(c, h);

    const auto touch = [&](double t, std::uint64_t id) {
        const Vec3 p = c.p + t * c.d;
        const Vec3 q = p + way_out(p, n, h) * n;
        e.point(to_outer(e.x.world, q), to_outer(e.x.world, p), -rotated(e.x.world, n), 0,
                e.y.shape.radius, feature_key({id, facing(n)}));
    };
    const auto height = [&](double t) { return -way_out(c.p + t * c.d, n, h); };

    // Both ends of the stretch, and its lowest point where that is lower still.
    const Stretch s = in_shadow(c, n, h);
    const double low = std::min(s.low, s.high), high = std::max(s.low, s.high);
    const double lowest = least_at(low, high, height);
    const double ends = std::min(height(low), height(high));
    const bool short_stretch = (high - low) * norm(c.d) < 1e-7;
    if (short_stretch || height(lowest) < ends - 1e-9) touch(lowest, 100);
    if (short_stretch) return;
    touch(low, s.low_end);
    touch(high, s.high_end);
}

}  // namespace plumb::reference
