// SPDX-License-Identifier: MIT
/// One face is cut by the prism that stands over the other one along the normal (Sutherland and
/// Hodgman); what is left is measured against the other face's plane, along the normal. Segments
/// and points are the short cases.
#include "manifold/clip.h"

namespace plumb {
namespace {

constexpr std::uint32_t kWindowLine = 64;  ///< lines of the cutting face are numbered from here

/// The face that is cut, the face that cuts, and the way from one to the other.
struct Roles {
    const SupportFace &subject, &window;
    bool subject_is_a;
    Vec3 n;        ///< out of b towards a
    double slack;  ///< a corner this far outside still counts as inside [m]
};

void emit(FacingPoints& out, const Roles& r, Vec3 p, Vec3 q, std::uint32_t feature) {
    // p lies on the subject; q is any point of the window right over it.
    const double way = dot(r.n, q - p);
    const Vec3 other = p + way * r.n;
    const double gap = (r.subject_is_a ? -way : way) - r.subject.radius - r.window.radius;
    if (r.subject_is_a)
        out.add({p, other, gap, feature});
    else
        out.add({other, p, gap, feature});
}

/// The point of the window's plane over p.
Vec3 on_plane(const Roles& r, Vec3 p) {
    const double height = dot(r.window.normal, r.window.corner[0] - p) / dot(r.window.normal, r.n);
    return p + height * r.n;
}

/// Inward unit normal of the side of the prism over the window's edge i.
Vec3 side_normal(const Roles& r, int i) {
    const Vec3 edge = r.window.corner[i + 1 < r.window.count ? i + 1 : 0] - r.window.corner[i];
    const Vec3 up = dot(r.window.normal, r.n) > 0 ? r.n : -r.n;
    return unit_or(cross(up, edge), {0, 0, 0});
}

struct Corner {
    Vec3 p;
    std::uint32_t line;  ///< the line that leaves this corner
};

struct Polygon {
    Corner corner[FacingPoints::kMost];
    int count = 0;
    void add(Vec3 p, std::uint32_t line) {
        if (count < FacingPoints::kMost) corner[count++] = {p, line};
    }
};

void cut(Polygon& out, const Polygon& in, Vec3 p, Vec3 m, std::uint32_t line, double slack) {
    out.count = 0;
    const double first = dot(m, in.corner[0].p - p);
    double dc = first;
    for (int i = 0; i < in.count; ++i) {
        const bool is_last = i + 1 == in.count;
        const Corner &c = in.corner[i], &d = in.corner[is_last ? 0 : i + 1];
        const double dd = is_last ? first : dot(m, d.p - p);
        const bool c_inside = dc >= -slack, d_inside = dd >= -slack;
        if (c_inside) out.add(c.p, c.line);
        // cut where the slack ends, or an edge that runs along the line would be cut far outside of
        // itself
        if (c_inside != d_inside)
            out.add(c.p + ((dc + slack) / (dc - dd)) * (d.p - c.p), c_inside ? line : c.line);
        dc = dd;
    }
}

void polygon_in_polygon(FacingPoints& out, const Roles& r) {
    Polygon first, second;
    Polygon *now_at = &first, *next_at = &second;
    for (int i = 0; i < r.subject.count; ++i)
        now_at->add(r.subject.corner[i], static_cast<std::uint32_t>(i));
    for (int i = 0; i < r.window.count && now_at->count; ++i) {
        const auto line = kWindowLine + static_cast<std::uint32_t>(i);
        cut(*next_at, *now_at, r.window.corner[i], side_normal(r, i), line, r.slack);
        std::swap(now_at, next_at);
    }
    const Polygon& now = *now_at;
    for (int i = 0; i < now.count; ++i) {
        const Corner& before = now.corner[i > 0 ? i - 1 : now.count - 1];
        emit(out, r, now.corner[i].p, on_plane(r, now.corner[i].p),
             128 * before.line + now.corner[i].line);
    }
}

/// The stretch of a segment that is left, and the lines that cut it.
struct Stretch {
    double low = 0, high = 1;
    std::uint32_t low_line = 0, high_line = 1;
};

void emit(FacingPoints& out, const Roles& r, const Stretch& s) {
    if (s.low > s.high) return;
    const Vec3 p = r.subject.corner[0], d = r.subject.corner[1] - p;
    emit(out, r, p + s.low * d, on_plane(r, p + s.low * d), 128 * 0 + s.low_line);
    if ((s.high - s.low) * norm(d) > 1e-9)
        emit(out, r, p + s.high * d, on_plane(r, p + s.high * d), 128 * 1 + s.high_line);
}

/// A flat round end is round here, and no polygon: what lies on it may balance on its rim.
void segment_in_disc(FacingPoints& out, const Roles& r) {
    const Vec3 start = on_plane(r, r.subject.corner[0]) - r.window.rim_centre;
    const Vec3 way = on_plane(r, r.subject.corner[1]) - r.window.rim_centre - start;
    const double radius = r.window.rim_radius + r.slack, a = dot(way, way), b = dot(way, start);
    const double root = b * b - a * (dot(start, start) - radius * radius);
    if (!(root >= 0) || a < 1e-18) return;
    const double in = (-b - std::sqrt(root)) / a, from = (-b + std::sqrt(root)) / a;
    Stretch s;
    if (in > 0) s.low = in, s.low_line = kWindowLine;
    if (from < 1) s.high = from, s.high_line = kWindowLine;
    emit(out, r, s);
}

void segment_in_polygon(FacingPoints& out, const Roles& r) {
    const Vec3 p = r.subject.corner[0], d = r.subject.corner[1] - p;
    Stretch s;
    for (int i = 0; i < r.window.count; ++i) {
        const Vec3 m = side_normal(r, i);
        const double start = dot(m, p - r.window.corner[i]) + r.slack, slope = dot(m, d);
        const auto line = kWindowLine + static_cast<std::uint32_t>(i);
        if (start < 0 && start + slope < 0) return;
        if (start < 0 && -start / slope > s.low) s.low = -start / slope, s.low_line = line;
        if (start + slope < 0 && -start / slope < s.high)
            s.high = -start / slope, s.high_line = line;
    }
    emit(out, r, s);
}

void point_in_disc(FacingPoints& out, const Roles& r) {
    const Vec3 p = r.subject.corner[0];
    if (norm(on_plane(r, p) - r.window.rim_centre) <= r.window.rim_radius + r.slack)
        emit(out, r, p, on_plane(r, p), 0);
}

void point_in_polygon(FacingPoints& out, const Roles& r) {
    const Vec3 p = r.subject.corner[0];
    for (int i = 0; i < r.window.count; ++i)
        if (dot(side_normal(r, i), p - r.window.corner[i]) < -r.slack) return;
    emit(out, r, p, on_plane(r, p), 0);
}

/// Two segments: the stretch along which they run side by side, or the point where they cross.
void segment_on_segment(FacingPoints& out, const Roles& r) {
    const auto flat = [&](Vec3 v) { return v - dot(v, r.n) * r.n; };
    const Vec3 p = r.subject.corner[0], d = r.subject.corner[1] - p;
    const Vec3 q = r.window.corner[0], e = r.window.corner[1] - q;
    const Vec3 df = flat(d), ef = flat(e), offset = flat(q - p);
    const double dd = dot(df, df), ee = dot(ef, ef), turn = dot(r.n, cross(df, ef));
    if (dd < 1e-18 || ee < 1e-18) return;

    if (std::abs(turn) < 1e-3 * std::sqrt(dd * ee)) {
        if (norm(cross(df, offset)) > (1e-3 * std::sqrt(ee) + r.slack) * std::sqrt(dd)) return;
        const double t0 = dot(df, offset) / dd, t1 = dot(df, offset + ef) / dd;
        const double low = std::max(0.0, std::min(t0, t1)), high = std::min(1.0, std::max(t0, t1));
        if (low > high) return;
        for (int end = 0; end < 2; ++end) {
            const double t = end ? high : low, s = (t - t0) / (t1 - t0);
            emit(out, r, p + t * d, q + s * e, 1 + static_cast<std::uint32_t>(end));
        }
        return;
    }
    const double t = dot(r.n, cross(offset, ef)) / turn, s = dot(r.n, cross(offset, df)) / turn;
    const double slack_t = r.slack / std::sqrt(dd), slack_s = r.slack / std::sqrt(ee);
    if (t < -slack_t || t > 1 + slack_t || s < -slack_s || s > 1 + slack_s) return;
    emit(out, r, p + t * d, q + s * e, 3);
}

void point_on_segment(FacingPoints& out, const Roles& r) {
    const Vec3 p = r.subject.corner[0], q = r.window.corner[0], e = r.window.corner[1] - q;
    const auto flat = [&](Vec3 v) { return v - dot(v, r.n) * r.n; };
    const Vec3 ef = flat(e), offset = flat(p - q);
    const double ee = dot(ef, ef),
                 s = ee > 1e-18 ? std::min(1.0, std::max(0.0, dot(offset, ef) / ee)) : 0;
    if (norm(offset - s * ef) <= r.slack) emit(out, r, p, q + s * e, 0);
}

/// The greatest distance of a face's corners from the first [m].
double extent_of(const SupportFace& face) {
    double extent = 0;
    for (int i = 1; i < face.count; ++i)
        extent = std::max(extent, norm(face.corner[i] - face.corner[0]));
    return extent;
}

}  // namespace

FacingPoints facing_points(const SupportFace& a, const SupportFace& b, Vec3 n) {
    // The simpler face is cut by the richer one.
    const bool a_is_subject = std::min(a.count, 3) <= std::min(b.count, 3);
    const SupportFace &subject = a_is_subject ? a : b, &window = a_is_subject ? b : a;
    // What is left is no larger than the smaller of them: a slack of the larger one's would move
    // the points of a wheel on a long floor.
    double size = extent_of(subject) + subject.radius;
    if (window.count >= 3) size = std::min(size, extent_of(window));
    const Roles r{subject, window, a_is_subject, n, 1e-7 * size + 1e-12};

    FacingPoints out;
    const bool round = window.rim_radius > 0;
    if (window.count >= 3)
        (subject.count >= 3   ? polygon_in_polygon
         : subject.count == 2 ? (round ? segment_in_disc : segment_in_polygon)
                              : (round ? point_in_disc : point_in_polygon))(out, r);
    else if (window.count == 2)
        (subject.count == 2 ? segment_on_segment : point_on_segment)(out, r);
    else
        emit(out, r, subject.corner[0], window.corner[0], 0);
    return out;
}

}  // namespace plumb
