// SPDX-License-Identifier: MIT
#include "manifold/support.h"

namespace plumb {
namespace {

constexpr int kRim = 8;  ///< corners of the polygon that stands for a flat round end

Vec3 hull_support(const Part& part, Vec3 d_own) {
    const Shape& s = part.shape;
    std::uint32_t best = 0;
    double most = -1e300;
    for (std::uint32_t i = 0; i < s.vertex_count; ++i) {
        const double along = dot(s.vertices[i], d_own);
        if (along > most) most = along, best = i;
    }
    return s.vertices[best];
}

/// Unit vector from the axis towards d, across the axis (y); x where d is along the axis.
Vec3 outward(Vec3 d_own) { return unit_or({d_own.x, 0, d_own.z}, {1, 0, 0}); }

/// The corner farthest along d. Without a branch, for no processor foresees the signs; 0 added to
/// them makes −0 count as 0.
Vec3 box_support(Vec3 half, Vec3 d) {
    return {std::copysign(half.x, d.x + 0.0), std::copysign(half.y, d.y + 0.0),
            std::copysign(half.z, d.z + 0.0)};
}

Vec3 own_support(const Part& part, Vec3 d) {
    const Shape& s = part.shape;
    switch (s.kind) {
        case ShapeKind::box:
            return box_support(s.half_extents, d);
        case ShapeKind::capsule:
            return {0, d.y >= 0 ? s.half_height : -s.half_height, 0};
        case ShapeKind::cylinder: {
            const Vec3 rim = s.radius * outward(d);
            return {rim.x, d.y >= 0 ? s.half_height : -s.half_height, rim.z};
        }
        case ShapeKind::cone: {
            const Vec3 rim = s.radius * outward(d), base{rim.x, -s.half_height, rim.z};
            const Vec3 apex{0, s.half_height, 0};
            return dot(apex, d) > dot(base, d) ? apex : base;
        }
        case ShapeKind::hull:
            return hull_support(part, d);
        default:
            return {0, 0, 0};
    }
}

void box_face(SupportFace& face, const Shape& s, Vec3 d) {
    const double along[] = {d.x, d.y, d.z};
    const double half[] = {s.half_extents.x, s.half_extents.y, s.half_extents.z};
    int k = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(along[i]) > std::abs(along[k]) + 1e-9) k = i;
    const double side = along[k] >= 0 ? 1 : -1;
    const int u = k < 2 ? k + 1 : 0, v = u < 2 ? u + 1 : 0;
    double p[3];
    p[k] = side * half[k];
    for (int i = 0; i < 4; ++i) {
        p[u] = i == 0 || i == 3 ? half[u] : -half[u];
        p[v] = (i < 2 ? side : -side) * half[v];
        face.add({p[0], p[1], p[2]});
    }
    at(face.normal, k) = side;
    face.id = 2 * static_cast<std::uint32_t>(k) + (side > 0);
}

/// A flat round end at height y: a regular polygon fixed to the shape, and the rim's deepest point
/// where tilted.
void disc_face(SupportFace& face, double radius, double y, Vec3 d) {
    const double side = y > 0 ? 1 : -1;
    const bool tilted = std::hypot(d.x, d.z) > 1e-4;
    const double deepest =
        std::atan2(side * d.z, d.x);  // angles run counter-clockwise seen from outside
    bool pending = tilted;
    for (int i = 0; i < kRim; ++i) {
        const double angle = -M_PI + 2 * M_PI * i / kRim;
        if (pending && deepest < angle) {
            if (angle - deepest > 1e-6)
                face.add({radius * std::cos(deepest), y, side * radius * std::sin(deepest)});
            pending = false;
        }
        face.add({radius * std::cos(angle), y, side * radius * std::sin(angle)});
    }
    if (pending) face.add({radius * std::cos(deepest), y, side * radius * std::sin(deepest)});
    // Seen from above (+y), angles from x to z run clockwise: turn the order.
    std::reverse(face.corner, face.corner + face.count);
    face.normal = {0, side, 0};
    face.rim_centre = {0, y, 0};
    face.rim_radius = radius;
    face.id = side > 0 ? 1 : 2;
}

void cylinder_face(SupportFace& face, const Shape& s, Vec3 d) {
    if (std::abs(d.y) > 0.7)
        return disc_face(face, s.radius, d.y > 0 ? s.half_height : -s.half_height, d);
    const Vec3 rim = s.radius * outward(d);
    face.add({rim.x, -s.half_height, rim.z});
    face.add({rim.x, s.half_height, rim.z});
    face.id = 3;
    if (std::abs(d.y) < 0.05) face.side_radius = s.radius;
}

void cone_face(SupportFace& face, const Shape& s, Vec3 d) {
    // The base, or the line of the mantle below d: whichever looks more along d.
    const Vec3 out = outward(d);
    const Vec3 mantle = unit_or(2 * s.half_height * out + Vec3{0, s.radius, 0}, out);
    if (-d.y >= dot(mantle, d)) return disc_face(face, s.radius, -s.half_height, d);
    face.add({s.radius * out.x, -s.half_height, s.radius * out.z});
    face.add({0, s.half_height, 0});
    face.id = 3;
}

void hull_face(SupportFace& face, const Part& part, Vec3 d) {
    // Among the faces at the farthest vertex, the one that looks most along d.
    const Shape& s = part.shape;
    const double most = dot(hull_support(part, d), d), slack = 1e-9 * size_of(part);
    int best = -1;
    double best_along = -2;
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
        const double along = dot(part.faces[f].normal, d);
        if (along <= best_along + 1e-9) continue;
        for (std::uint32_t i : part.faces[f].corners)
            if (dot(s.vertices[i], d) >= most - slack) {
                best = static_cast<int>(f), best_along = along;
                break;
            }
    }
    if (best < 0) return face.add(hull_support(part, d));
    for (std::uint32_t i : part.faces[static_cast<std::size_t>(best)].corners)
        face.add(s.vertices[i]);
    face.normal = part.faces[static_cast<std::size_t>(best)].normal;
    face.id = static_cast<std::uint32_t>(best);
}

void plane_face(SupportFace& face, Vec3 around, double half) {
    for (int i = 0; i < 4; ++i) {
        const double u = i == 0 || i == 3 ? half : -half, v = i < 2 ? half : -half;
        face.add({around.x + v, 0, around.z + u});
    }
    face.normal = {0, 1, 0};
}

void capsule_face(SupportFace& face, const Shape& s) {
    face.add({0, -s.half_height, 0});
    if (s.half_height > 0) face.add({0, s.half_height, 0});
}

/// A polygon seen almost edge-on cannot be measured along d: keep its edge at the farthest corner.
void flatten(SupportFace& face, Vec3 d) {
    if (face.count < 3 || dot(face.normal, d) > 0.05) return;
    int k = 0;
    for (int i = 1; i < face.count; ++i)
        if (dot(face.corner[i], d) > dot(face.corner[k], d)) k = i;
    const int before = (k + face.count - 1) % face.count, after = (k + 1) % face.count;
    const int other = dot(face.corner[before], d) > dot(face.corner[after], d) ? before : after;
    const Vec3 p = face.corner[k], q = face.corner[other];
    face.id = 1000000 + 64 * face.id + static_cast<std::uint32_t>(other == before ? before : k);
    face.count = 0;
    face.add(p);
    face.add(q);
}

/// How far a part reaches along d [m]: without detours for the shapes that most things are.
inline double reach(const Part& part, Vec3 d) {
    const Shape& s = part.shape;
    switch (s.kind) {
        case ShapeKind::plane:
            return dot(part.world.origin, d);
        case ShapeKind::sphere:
            return dot(part.world.origin, d) + s.radius;
        case ShapeKind::box:
            return dot(
                to_outer(part.world, box_support(s.half_extents, turned_back(part.world, d))), d);
        default:
            return dot(core_support(part, d), d) + core_radius(part);
    }
}

}  // namespace

Vec3 core_support(const Part& part, Vec3 d) {
    if (part.shape.kind == ShapeKind::sphere) return part.world.origin;
    return to_outer(part.world, own_support(part, turned_back(part.world, d)));
}

double support_gap(const Part& a, const Part& b, Vec3 n) { return -reach(a, -n) - reach(b, n); }

double size_of(const Part& part) {
    const Shape& s = part.shape;
    switch (s.kind) {
        case ShapeKind::plane:
            return 0;
        case ShapeKind::box:
            return norm(s.half_extents);
        case ShapeKind::hull:
        case ShapeKind::mesh:
        case ShapeKind::height_field:
            return 0.5 * norm(part.own_bounds.high - part.own_bounds.low);
        default:
            return s.radius + s.half_height;
    }
}

SupportFace support_face(const Part& part, Vec3 d, Vec3 around, double half) {
    SupportFace face;
    const Shape& s = part.shape;
    const Vec3 d_own = turned_back(part.world, d);
    switch (s.kind) {
        case ShapeKind::plane:
            plane_face(face, to_inner(part.world, around), half);
            break;
        case ShapeKind::box:
            box_face(face, s, d_own);
            break;
        case ShapeKind::capsule:
            capsule_face(face, s);
            break;
        case ShapeKind::cylinder:
            cylinder_face(face, s, d_own);
            break;
        case ShapeKind::cone:
            cone_face(face, s, d_own);
            break;
        case ShapeKind::hull:
            hull_face(face, part, d_own);
            break;
        default:
            face.add({0, 0, 0});
    }
    flatten(face, d_own);
    face.radius = core_radius(part);
    for (int i = 0; i < face.count; ++i) face.corner[i] = to_outer(part.world, face.corner[i]);
    face.normal = rotated(part.world, face.normal);
    face.rim_centre = to_outer(part.world, face.rim_centre);
    return face;
}

}  // namespace plumb
