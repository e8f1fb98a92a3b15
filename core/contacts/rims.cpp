// SPDX-License-Identifier: MIT
#include "contacts/rims.h"

#include "contacts/contact_measures.h"
#include "math/rotation.h"
#include "world/round_shapes.h"

#include <cmath>

namespace plumb {
namespace {

/// A rim flatter than this against the normal touches with its face, as colliders take it.
constexpr double kStraight = 1e-5;

/// Share of the radius by which a point may lie beside the rim's deepest one and still be it.
constexpr double kBeside = 1e-5;

/// A part of a body: its shape, and where that is in the body's frame.
struct PlacedPart {
    const Shape* shape;
    Placement local;
};

PlacedPart part_of(const World& world, std::uint32_t body, std::uint32_t part) {
    const std::uint32_t geometry = world.bodies.geometry[body];
    if (geometry == kNoIndex) return {nullptr, {}};
    const Shape& shape = world.shapes[geometry];
    const Placement& local = world.bodies.geometry_in_body[body];
    if (shape.kind != ShapeKind::compound) return {&shape, local};
    if (part >= shape.part_count) return {nullptr, {}};
    const ShapePart& p = shape.parts[part];
    return {&p.shape, local * Placement{to_eigen(p.local.position), to_eigen(p.local.rotation)}};
}

/// The rim of a shape that is farthest along d, in the shape's frame; radius 0: none.
Rim rim_towards(const Shape& shape, const Vector3d& d) {
    if (!has_rim(shape.kind)) return {};
    const double side = shape.kind == ShapeKind::cone || d.y() < 0 ? -1 : 1;
    return {{0, side * shape.half_height, 0}, Vector3d::UnitY(), shape.radius};
}

/// Whether a point is on a rim, both in the body's frame.
bool is_on(const Rim& rim, const Vector3d& point, double near) {
    const Vector3d from = point - rim.centre;
    const double along = from.dot(rim.axis);
    return std::abs(along) < near && std::abs((from - along * rim.axis).norm() - rim.radius) < near;
}

/// The rim of `body` on which `point` is, that is farthest along `direction`; both in the world.
ContactRim rim_at(const World& world, std::uint32_t body, std::uint32_t part, const Vec3& point,
                  const Vector3d& direction) {
    const PlacedPart placed = part_of(world, body, part);
    if (!placed.shape) return {};
    const Bodies& b = world.bodies;
    const Quaterniond back = b.orientation[body].conjugate();
    const Vector3d d = back * direction, p = in_body(b, body, to_eigen(point));
    Rim rim = rim_towards(*placed.shape, placed.local.rotation.conjugate() * d);
    if (rim.radius == 0) return {};
    rim.centre = placed.local.position + placed.local.rotation * rim.centre;
    rim.axis = placed.local.rotation * rim.axis;
    const double near = kBeside * rim.radius;
    if (!is_on(rim, p, near)) return {};
    const bool tilted = d.cross(rim.axis).norm() > kStraight;
    const Vector3d beside = p - farthest_on(rim, d, p);
    // as deep as the collider has it, or the gap of the next substep would be another
    rim.centre += d.dot(beside) * d;
    return {rim, body, tilted && beside.squaredNorm() < near * near};
}

/// The normal of a contact on a rim, from the rim to what it touches.
Vector3d outward_at(const ContactTable& c, std::size_t contact) {
    const Vector3d n = to_eigen(c.found[contact].normal);
    return c.rims[contact].body == c.found[contact].a ? Vector3d(-n) : n;
}

/// From the centre of mass to a contact's point on its rim [m], in the world, with the body at an
/// orientation q; n points from the rim to what it touches.
Vector3d arm_at(const ContactRim& at, const Quaterniond& q, const Vector3d& n,
                const Vector3d& point) {
    return q * (at.runs ? farthest_on(at.rim, q.conjugate() * n, point) : point);
}

/// How far a rim's axis may swing in a substep [rad]: beyond, its lowest point at the end is not to
/// be foreseen from the rate at the start, and contacts that ask for it make energy.
constexpr double kFarSwing = 0.25;

/// How far a contact runs along its rim in a substep of h [s], on the body [m].
double run_along(const Bodies& b, const ContactRim& at, const Vector3d& n, double h) {
    const Quaterniond& q = b.orientation[at.body];
    const Quaterniond end = turned(q, Vector3d(h * b.angular_velocity[at.body]));
    const Vector3d from = farthest_on(at.rim, q.conjugate() * n, Vector3d::Zero());
    return (farthest_on(at.rim, end.conjugate() * n, from) - from).norm();
}

/// From which angle on in a substep a rim rolls on [rad], and up to which: all but flat, its
/// contact whirls about, and where that comes to is not foreseen. Other points that come into the
/// place of its deepest one are this near to it and to its rim, in radii, and their normals as
/// parallel.
constexpr double kRollsOn = 0.01, kWhirls = 0.2, kNear = 0.5, kOnRim = 1e-3, kParallel = 1 - 1e-4;

/// Whether a contact is one of those points: of the same rim against the same face. A rim's centre
/// is where its contact is as deep as it is: that differs along the normal.
bool rolls_into(const World& world, std::uint32_t other, std::uint32_t deepest) {
    const ContactTable& c = world.contacts;
    const ContactRim &of = c.rims[other], &at = c.rims[deepest];
    if (of.body != at.body || of.rim.radius != at.rim.radius) return false;
    const Vector3d n = outward_at(c, deepest);
    const Vector3d beside =
        (world.bodies.orientation[at.body] * (of.rim.centre - at.rim.centre)).cross(n);
    return beside.norm() < kOnRim * at.rim.radius &&
           (c.point[other] - c.point[deepest]).norm() < kNear * at.rim.radius &&
           outward_at(c, other).dot(n) > kParallel;
}

}  // namespace

Vector3d farthest_on(const Rim& rim, const Vector3d& direction, const Vector3d& otherwise) {
    const Vector3d out = direction - direction.dot(rim.axis) * rim.axis;
    const double length = out.norm();
    return length > kStraight ? Vector3d(rim.centre + (rim.radius / length) * out) : otherwise;
}

void find_rims(World& world) {
    ContactTable& c = world.contacts;
    c.rims.assign(c.found.size(), {});
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Contact& contact = c.found[i];
        if (!is_sharp(contact)) continue;
        const Vector3d n = to_eigen(contact.normal);
        c.rims[i] = rim_at(world, contact.a, contact.part_a, contact.point_a, -n);
        if (c.rims[i].rim.radius > 0) continue;
        c.rims[i] = rim_at(world, contact.b, contact.part_b, contact.point_b, n);
    }
}

void forget_rims(World& world) { world.contacts.rims.clear(); }

Vector3d bend_at_rim(const World& world, std::size_t contact, double h) {
    const ContactTable& c = world.contacts;
    const Bodies& b = world.bodies;
    const ContactRim& at = c.rims[contact];
    const double sign = at.body == c.found[contact].a ? 1 : -1;
    const Vector3d n = outward_at(c, contact), w = b.angular_velocity[at.body];
    const Quaterniond& q = b.orientation[at.body];
    if (h * w.cross(q * at.rim.axis).norm() > kFarSwing) return Vector3d::Zero();
    const Vector3d point = in_body(b, at.body, c.point[contact]);
    const Vector3d now = arm_at(at, q, n, point),
                   middle = arm_at(at, turned(q, 0.5 * h * w), n, point),
                   end = arm_at(at, turned(q, h * w), n, point);
    // what falls flat would go on on the other side, but stops
    if ((end - now).squaredNorm() > 2 * at.rim.radius * at.rim.radius) return Vector3d::Zero();
    // along the normal how far it comes by the end, across it how fast it is in the middle
    const Vector3d across = w.cross(middle - now);
    const double along = n.dot(end - now) / h - n.dot(w.cross(now));
    return sign * (across + (along - n.dot(across)) * n);
}

void leave_to_rolling(World& world, const ContactPair& pair, double h) {
    ContactTable& c = world.contacts;
    for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
        const ContactRim& at = c.rims[i];
        if (!at.runs || c.gap[i] == kOutOfReach) continue;
        const double run = run_along(world.bodies, at, outward_at(c, i), h);
        if (run < kRollsOn * at.rim.radius || run > kWhirls * at.rim.radius) continue;
        for (std::uint32_t k = pair.first; k < pair.first + pair.count; ++k)
            if (k != i && rolls_into(world, k, i)) c.gap[k] = kOutOfReach;
    }
}

void follow_rims(World& world) {
    ContactTable& c = world.contacts;
    const Bodies& b = world.bodies;
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        if (!c.rims[i].runs) continue;
        const Rim& rim = c.rims[i].rim;
        const Contact& contact = c.found[i];
        const bool of_a = c.rims[i].body == contact.a;
        const std::uint32_t round = of_a ? contact.a : contact.b,
                            other = of_a ? contact.b : contact.a;
        Vector3d &on_round = of_a ? c.track[i].a : c.track[i].b,
                 &on_other = of_a ? c.track[i].b : c.track[i].a;
        const Vector3d n = outward_at(c, i);
        on_round = farthest_on(rim, b.orientation[round].conjugate() * n, on_round);
        // its opposite is in the plane across the normal in which it was
        const Vector3d at = in_world(b, round, on_round), was = in_world(b, other, on_other);
        on_other = in_body(b, other, at + n.dot(was - at) * n);
    }
}

}  // namespace plumb
