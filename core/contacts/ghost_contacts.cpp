// SPDX-License-Identifier: MIT
#include "contacts/ghost_contacts.h"

#include "contacts/contact_measures.h"
#include "contacts/contact_reach.h"
#include "contacts/pair_poses.h"
#include "geometry/shape_support.h"
#include "world/round_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plumb {
namespace {

/// By how much of the body's radius a slab may stand out above the plane and still be below it:
/// those that lie loose differ by their overlaps. A wheel of radius r loses 2 s/r of its speed at
/// a step of s.
constexpr double kFlush = 1e-4;

/// Normals that differ by no more than this make one plane [rad]: what rolls loses the square of
/// that, as a share of its speed.
constexpr double kSamePlane = 1e-3;

/// Share of the body's radius by which its point may lie outside of the hull of those that are
/// held.
constexpr double kOutside = 1e-3;

/// Of a body that touches more, those that just touch are looked at.
constexpr std::uint32_t kMostOthers = 48;

/// What moves in a step by less than this share of its radius is judged once in so many.
constexpr double kMoves = 1e-3;
constexpr std::uint64_t kSeldom = 16;

/// A mesh of more vertices is not searched for its highest.
constexpr std::uint32_t kFewVertices = 500;

/// What of a body a contact holds.
struct Hold {
    std::uint32_t part;
    Vector3d anchor;  ///< [m]
    Vector3d normal;  ///< out of the other body
    double radius;    ///< from the anchor to the body's surface [m]

    Hold(const Contact& c, std::uint32_t body) {
        const bool is_a = c.a == body;
        const Vector3d n = to_eigen(c.normal);
        part = is_a ? c.part_a : c.part_b;
        anchor = to_eigen(is_a ? c.point_a : c.point_b), radius = is_a ? c.radius_a : c.radius_b;
        normal = is_a ? n : Vector3d(-n);
    }
};

const Shape& shape_of_part(const World& world, std::uint32_t body, std::uint32_t part) {
    const Shape& shape = world.shapes[world.bodies.geometry[body]];
    const bool is_whole = shape.kind != ShapeKind::compound || part >= shape.part_count;
    return is_whole ? shape : shape.parts[part].shape;
}

PlacedShape placed_shape(const World& world, std::uint32_t body, std::uint32_t part) {
    const Bodies& b = world.bodies;
    const Placement& local = b.geometry_in_body[body];
    return placed_part(world.shapes[b.geometry[body]],
                       {to_plain(local.position), to_plain(local.rotation)},
                       {to_plain(b.position[body]), to_plain(b.orientation[body])}, part);
}

/// The point of a body that a contact holds, were its normal n: what is round is held below its
/// centre, what is on the side of a cylinder below its axis [m].
Vector3d held_point(const World& world, std::uint32_t body, const Hold& at, const Vector3d& n) {
    if (!has_rim(shape_of_part(world, body, at.part).kind)) return at.anchor - at.radius * n;
    const PlacedShape shape = placed_shape(world, body, at.part);
    const Vector3d touching = at.anchor - at.radius * at.normal;
    const Vector3d axis = shape.rotation * Vector3d::UnitY(), from = touching - shape.origin;
    const double along = from.dot(axis), radius = shape.shape->radius;
    const Vector3d out = from - along * axis, down = n.dot(axis) * axis - n;
    if (out.norm() < (1 - kOutside) * radius || down.norm() < kSamePlane) return touching;
    return shape.origin + along * axis + radius * down.normalized();
}

bool is_along(const Vector3d& m, const Vector3d& n) {
    return m.dot(n) > 0 && m.cross(n).squaredNorm() < kSamePlane * kSamePlane;
}

/// How fast the surface of a body rises along n at a point [m/s].
double rise_at(const Bodies& b, std::uint32_t body, const Vector3d& point, const Vector3d& n) {
    return n.dot(b.velocity[body] + b.angular_velocity[body].cross(point - b.position[body]));
}

/// How far a point of a plane is from the convex hull of others [m].
class Hull {
public:
    void add(const Eigen::Vector2d& from_point) {
        if (count_ == kMost) return;
        away_[count_++] = from_point;
    }
    double distance() const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count_; ++i)
            for (std::size_t k = 0; k <= i; ++k)
                least = std::min(least, to_edge(away_[i], away_[k]));
        return least > 0 && is_inside() ? 0 : least;
    }

private:
    static constexpr std::size_t kMost = 32;

    static double to_edge(const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
        const Eigen::Vector2d edge = q - p;
        const double length = edge.squaredNorm();
        const double at = length > 0 ? std::clamp(-p.dot(edge) / length, 0.0, 1.0) : 0;
        return (p + at * edge).norm();
    }
    /// Whether no half of the plane is free of them: each has one to its left within half a turn,
    /// and one to its right.
    bool is_inside() const {
        for (std::size_t i = 0; i < count_; ++i) {
            bool left = false, right = false;
            for (std::size_t k = 0; k < count_; ++k) {
                const double turn = away_[i].x() * away_[k].y() - away_[i].y() * away_[k].x();
                left |= turn > 0, right |= turn < 0;
            }
            if (!left || !right) return false;
        }
        return count_ > 2;
    }

    Eigen::Vector2d away_[kMost];
    std::size_t count_ = 0;
};

/// Whether a body moves far in the step.
bool is_fast(const World& world, std::uint32_t body) {
    const Bodies& b = world.bodies;
    const double radius = b.bounding_radius[body];
    if (b.motion[body] == Motion::fixed || !std::isfinite(radius)) return false;
    const double way = b.velocity[body].norm() + b.angular_velocity[body].norm() * radius;
    return way * world.settings.dt > kMoves * radius;
}

}  // namespace

GhostContacts::Plane::Plane(const Contact& c, std::uint32_t body, std::uint32_t of_contact)
    : contact(of_contact) {
    const bool is_a = c.a == body;
    const Vector3d n = to_eigen(c.normal);
    normal = is_a ? n : Vector3d(-n);
    surface = is_a ? Vector3d(to_eigen(c.point_b) + c.radius_b * n)
                   : Vector3d(to_eigen(c.point_a) - c.radius_a * n);
    other = is_a ? c.b : c.a;
    part = is_a ? c.part_a : c.part_b, other_part = is_a ? c.part_b : c.part_a;
}

/// Whether all of what a contact is with is clearly not below a plane: a ball in it stands out, and
/// no less where the plane is tilted a little. It does so by twice what is flush, which no rounding
/// makes good.
bool GhostContacts::stands_out(const World& world, const Plane& at, const Plane& plane,
                               double flush) {
    const Bodies& b = world.bodies;
    const double ball = inner_radius(world.shapes[b.geometry[at.other]]);
    const Vector3d centre = in_world(b, at.other, b.geometry_in_body[at.other].position);
    const double tilt = 2 * kSamePlane * (centre - at.surface).norm();
    return plane.normal.dot(centre - plane.surface) + ball - tilt > 2 * flush;
}

/// Whether all of what a contact is with is below a plane, or rises no more than planes that count
/// as one, and does not move above it within the step.
bool GhostContacts::lies_below(const World& world, const Plane& at, const Plane& plane,
                               double flush) {
    const PlacedShape other = placed_shape(world, at.other, at.other_part);
    if (other.shape->kind == ShapeKind::mesh && other.shape->vertex_count > kFewVertices)
        return false;
    const Vector3d& n = plane.normal;
    const double rise = rise_at(world.bodies, at.other, at.surface, n) -
                        rise_at(world.bodies, plane.other, plane.surface, n);
    const double most = flush - std::max(0.0, rise) * world.settings.dt;
    if (support(other, n) - n.dot(plane.surface) <= most) return true;
    // seen along a slope up from the contact: the far end of a slab that tilts stands out
    const Vector3d inward = (n.dot(at.normal) * n - at.normal).normalized();
    const Vector3d up = (n - kSamePlane * inward).normalized();
    return n.dot(at.surface - plane.surface) + support(other, up) - up.dot(at.surface) <= most;
}

/// Those that came with this step and may not be what they were.
void GhostContacts::choose(World& world) {
    ContactTable& c = world.contacts;
    judged_.clear();
    listed_.assign(world.bodies.size(), 0);
    for (const ContactMove& m : c.kept.comes)
        for (std::uint32_t i = m.to; i < m.to + m.count; ++i) {
            ContactMemory& memory = c.memory[i];
            const Contact& contact = c.found[i];
            const bool stays = memory.known && !memory.flush &&
                               (world.steps + contact.feature) % kSeldom != 0 &&
                               !is_fast(world, contact.a) && !is_fast(world, contact.b);
            memory.ghost = memory.flush = false;
            if (stays) continue;
            judged_.push_back(i);
            for (const std::uint32_t body : {contact.a, contact.b})
                listed_[body] = world.bodies.motion[body] == Motion::dynamic;
        }
}

/// The contacts of each body of which one is judged; first those that just touch, which carry it.
void GhostContacts::list_contacts(const World& world, Workers& workers) {
    const std::vector<Contact>& found = world.contacts.found;
    const std::vector<ContactPair>& pairs = world.contacts.pairs;
    const std::vector<Motion>& motion = world.bodies.motion;
    first_.assign(motion.size() + 1, 0);
    for (const ContactPair& pair : pairs)
        for (const std::uint32_t body : {pair.a, pair.b})
            if (listed_[body]) first_[body] += pair.count;
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    touches_.resize(first_.back()), planes_.resize(first_.back());
    for (const ContactPair& pair : pairs)
        for (const std::uint32_t body : {pair.a, pair.b}) {
            if (!listed_[body]) continue;
            for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i)
                touches_[--first_[body]] = {std::abs(found[i].gap), i};
        }
    workers.each(motion.size(), [&](std::uint32_t body, std::uint32_t) {
        if (!listed_[body]) return;
        std::sort(touches_.begin() + first_[body], touches_.begin() + first_[body + 1]);
        for (std::uint32_t k = first_[body]; k < first_[body + 1]; ++k)
            planes_[k] = Plane(found[touches_[k].contact], body, touches_[k].contact);
    });
}

/// Those that are looked at of the contacts of a body, as it sees them.
std::span<const GhostContacts::Plane> GhostContacts::planes_of(std::uint32_t body) const {
    return {planes_.data() + first_[body], std::min(first_[body + 1] - first_[body], kMostOthers)};
}

/// Looks for a plane that the same part of the body is above, as another contact keeps it, and all
/// that the contact is with lies below. Where such contacts hold its point, it is a ghost, and they
/// are left in `beneath_`; where they do not, it is turned to hold its own point above the plane.
GhostContacts::Verdict GhostContacts::judge(World& world, std::uint32_t contact,
                                            std::uint32_t body) {
    const Plane at(world.contacts.found[contact], body, contact);
    const double flush = kFlush * world.bodies.bounding_radius[body];
    // of a compound each part is a solid, a mesh is one
    const bool is_compound =
        world.shapes[world.bodies.geometry[at.other]].kind == ShapeKind::compound;
    for (const Plane& plane : planes_of(body)) {
        const bool is_one_solid =
            plane.other == at.other && !(is_compound && plane.other_part != at.other_part);
        if (is_one_solid || plane.normal.dot(at.surface - plane.surface) > flush) continue;
        const Verdict verdict = judge_above(world, at, plane, body);
        if (verdict != Verdict::real) return verdict;
    }
    return Verdict::real;
}

/// The verdict by one plane, below which the contact's point is.
GhostContacts::Verdict GhostContacts::judge_above(World& world, const Plane& at, const Plane& plane,
                                                  std::uint32_t body) {
    const ContactTable& c = world.contacts;
    const double radius = world.bodies.bounding_radius[body], flush = kFlush * radius;
    const Vector3d& n = plane.normal;
    if (is_ghost_[plane.contact] || plane.part != at.part || is_along(at.normal, n) ||
        !is_convex(shape_of_part(world, body, at.part).kind) ||
        stands_out(world, at, plane, flush) || !lies_below(world, at, plane, flush))
        return Verdict::real;
    const auto height = [&](const Vector3d& point) { return n.dot(point - plane.surface); };
    const Vector3d held = held_point(world, body, Hold(c.found[at.contact], body), n);
    if (height(held) < std::min(0.0, c.found[plane.contact].gap) - kOutside * radius)
        return Verdict::real;
    const auto in_plane = [&, u = Vector3d(n.unitOrthogonal())](const Vector3d& p) {
        return Eigen::Vector2d(u.dot(p - held), n.cross(u).dot(p - held));
    };
    Hull hull;
    beneath_.clear();
    for (const Plane& side : planes_of(body)) {
        if (side.contact == at.contact || is_ghost_[side.contact] || side.part != at.part ||
            !is_along(side.normal, n) || std::abs(height(side.surface)) > flush)
            continue;
        hull.add(in_plane(held_point(world, body, Hold(c.found[side.contact], body), n)));
        beneath_.push_back(side.contact);
    }
    if (hull.distance() <= kOutside * radius) return Verdict::ghost;
    turn(world, at.contact, body, n, held, height(held));
    return Verdict::turned;
}

/// Lets a contact hold a point of the body above a plane with the normal n, from which it is so far
/// away.
void GhostContacts::turn(World& world, std::uint32_t contact, std::uint32_t body, const Vector3d& n,
                         const Vector3d& held, double gap) {
    Contact& c = world.contacts.found[contact];
    const bool is_a = c.a == body;
    const Vector3d surface = held - gap * n;
    const double radius = is_a ? c.radius_a : c.radius_b, other = is_a ? c.radius_b : c.radius_a;
    (is_a ? c.point_a : c.point_b) = to_plain(Vector3d(held + radius * n));
    (is_a ? c.point_b : c.point_a) = to_plain(Vector3d(surface - other * n));
    c.normal = to_plain(Vector3d(is_a ? n : -n));
    c.gap = gap;
    for (const std::uint32_t side : {c.a, c.b})
        for (std::uint32_t k = first_[side]; k < first_[side + 1]; ++k)
            if (planes_[k].contact == contact) planes_[k] = Plane(c, side, contact);
    KeptContacts& kept = world.contacts.kept;
    if (kept.rides.empty()) return;
    kept.rides[contact] = PairPoses(world.contacts.frames, c.a, c.b).put_into_bodies(c);
}

void GhostContacts::judge_one(World& world, std::uint32_t contact) {
    ContactTable& c = world.contacts;
    for (const std::uint32_t body : {c.found[contact].a, c.found[contact].b}) {
        if (!listed_[body] || needed_[contact]) continue;
        const Verdict verdict = judge(world, contact, body);
        if (verdict == Verdict::real) continue;
        c.memory[contact].flush = true;
        c.memory[contact].ghost = verdict == Verdict::ghost;
        is_ghost_[contact] = c.memory[contact].ghost;
        if (verdict == Verdict::ghost)
            for (const std::uint32_t k : beneath_) needed_[k] = 1;
        return;
    }
}

void GhostContacts::find(World& world, Workers& workers) {
    ContactTable& c = world.contacts;
    choose(world);
    if (!judged_.empty()) {
        list_contacts(world, workers);
        needed_.assign(c.found.size(), 0);
        is_ghost_.resize(c.found.size());
        for (std::size_t i = 0; i < c.found.size(); ++i) is_ghost_[i] = c.memory[i].ghost;
        for (const std::uint32_t i : judged_) judge_one(world, i);
    }
    ghosts_.clear();
    for (std::uint32_t i = 0; i < c.found.size(); ++i)
        if (c.memory[i].ghost || is_out_of_reach(world, c.found[i])) ghosts_.push_back(i);
}

void GhostContacts::keep_open(ContactTable& contacts) const {
    for (const std::uint32_t i : ghosts_) contacts.gap[i] = kOutOfReach;
}

}  // namespace plumb
