// SPDX-License-Identifier: MIT
#include "reference/narrow.h"

namespace plumb::reference {

void Emitter::point(Vec3 anchor_x, Vec3 anchor_y, Vec3 normal, double radius_x, double radius_y,
                    std::uint64_t feature) const {
    const double gap = dot(normal, anchor_x - anchor_y) - radius_x - radius_y;
    if (!(gap <= margin)) return;
    Contact& c = swapped ? out.add(y, x) : out.add(x, y);
    c.point_a = swapped ? anchor_y : anchor_x;
    c.point_b = swapped ? anchor_x : anchor_y;
    c.radius_a = swapped ? radius_y : radius_x;
    c.radius_b = swapped ? radius_x : radius_y;
    c.normal = swapped ? -normal : normal;
    c.gap = gap;
    c.flags = kContactExact;
    c.feature = feature_key({feature, x.index, y.index});
}

Segment core_of(const Part& capsule) {
    const Vec3 half = capsule.shape.half_height * capsule.world.axis[1];
    return {capsule.world.origin - half, capsule.world.origin + half};
}

Box box_of(const Part& part) {
    const Frame& f = part.world;
    const Vec3& h = part.shape.half_extents;
    return {f.origin, {f.axis[0], f.axis[1], f.axis[2]}, {h.x, h.y, h.z}};
}

SegmentPair closest_of_segments(Vec3 p, Vec3 d, Vec3 q, Vec3 e) {
    const auto clamp = [](double t) { return std::min(1.0, std::max(0.0, t)); };
    const Vec3 r = p - q;
    const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
    if (dd < 1e-24) return {0, ee < 1e-24 ? 0 : clamp(er / ee)};
    if (ee < 1e-24) return {clamp(-dr / dd), 0};

    // Least squares on the lines, then back onto the segments, one after the other.
    const double det = dd * ee - de * de;
    double s = det > 1e-12 * dd * ee ? clamp((de * er - dr * ee) / det) : 0.5;
    double t = (de * s + er) / ee;
    if (t < 0 || t > 1) {
        t = clamp(t);
        s = clamp((de * t - dr) / dd);
    }
    // A second pass settles parallel segments, whose first guess was arbitrary.
    t = clamp((de * s + er) / ee);
    s = clamp((de * t - dr) / dd);
    return {s, t};
}

void collide(ContactList& out, const Part& a, const Part& b) {
    using Function = void (*)(const Emitter&);
    static constexpr Function table[4][4] = {{nullptr, plane_sphere, plane_box, plane_capsule},
                                             {nullptr, sphere_sphere, sphere_box, sphere_capsule},
                                             {nullptr, nullptr, box_box, box_capsule},
                                             {nullptr, nullptr, nullptr, capsule_capsule}};
    const bool swapped = b.shape.kind < a.shape.kind;
    const Part& x = swapped ? b : a;
    const Part& y = swapped ? a : b;
    const Function f = table[static_cast<int>(x.shape.kind)][static_cast<int>(y.shape.kind)];
    if (f) f({out, x, y, swapped, pair_margin(a, b)});
}

}  // namespace plumb::reference
