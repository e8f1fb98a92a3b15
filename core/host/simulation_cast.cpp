// SPDX-License-Identifier: MIT
/// Shapes that are cast along a way: conservative advancement (Mirtich, Impulse-based Dynamic
/// Simulation of Rigid Body Systems, 1996, 2.3).
///
/// A contact's normal n is that of a plane between two convex parts that are a gap g apart, so they
/// cannot meet before the shape has come g/(n · d) along its way d. It advances by the least of
/// these, and by no more than the margin, up to which all gaps are known, until one is closed.
#include "host/guest.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plumb {
namespace {

/// A gap that is closed, as a share of the shape's bounding radius, and a direction that is along a
/// surface.
constexpr double kClosed = 1e-9, kAlong = 1e-9;

/// What bounds the advance to the margin, in bounding radii, and advances before the shape counts
/// as meeting what it comes no nearer to.
constexpr double kMargin = 2;
constexpr int kMostAdvances = 1000;

/// An overlap, as a share of the bounding radius, that tells that an advance was too far: not every
/// collider's normal is that of a plane between. The shape goes back half of the way then, until it
/// overlaps no more.
constexpr double kDeep = 1e-7;
constexpr int kHalvings = 60;

/// The contact that bounds the advance, and by how far [m].
struct Bound {
    const Contact* contact = nullptr;
    double advance;
};

/// How far a shape may go along `direction` before it meets the body of a contact [m].
double free_way(const Contact& c, const Vector3d& direction, double closed) {
    const double approach = to_eigen(c.normal).dot(direction);
    if (approach <= kAlong) return std::numeric_limits<double>::infinity();
    return c.gap <= closed ? 0 : c.gap / approach;
}

Bound least_way(const std::vector<Contact>& contacts, const Vector3d& direction, double closed,
                double margin) {
    Bound least{nullptr, margin};
    for (const Contact& c : contacts) {
        const double way = free_way(c, direction, closed);
        if (way < least.advance) least = {&c, way};
    }
    return least;
}

const Contact* deepest(const std::vector<Contact>& contacts) {
    const auto least =
        std::min_element(contacts.begin(), contacts.end(),
                         [](const Contact& x, const Contact& y) { return x.gap < y.gap; });
    return least == contacts.end() ? nullptr : &*least;
}

bool overlaps_by(const std::vector<Contact>& contacts, double overlap) {
    const Contact* contact = deepest(contacts);
    return contact && contact->gap < -overlap;
}

}  // namespace

std::optional<ShapeHit> Simulation::cast_shape(std::uint32_t geometry, const Placement& from,
                                               const Eigen::Vector3d& direction, double length,
                                               std::uint32_t mask) {
    expect_placement(from);
    if (!(std::abs(direction.norm() - 1) < 1e-6))
        throw std::invalid_argument("the direction of a shape that is cast must have length 1");
    if (!(length >= 0) || !std::isfinite(length))
        throw std::invalid_argument("a shape is cast over a finite length of at least 0");
    Parts::Guest guest(*parts_, geometry, mask);
    const double size = std::isfinite(guest.bounding_radius()) ? guest.bounding_radius() : length;
    const double closed = kClosed * size, margin = kMargin * std::max(size, length / 1000);
    const auto hit = [&](const Contact& c, double distance) {
        ShapeHit met{parts_->world.bodies.id[c.a], c.part_a, distance, to_eigen(c.point_a),
                     -to_eigen(c.normal)};
        met.point += c.radius_a * met.normal;
        guest.leave();
        return std::optional(met);
    };

    Placement at = from;
    const std::vector<Contact>& start = guest.contacts_at(at, 0);
    if (overlaps_by(start, closed)) return hit(*deepest(start), 0);
    const auto contacts_after = [&](double way) -> const std::vector<Contact>& {
        at.position = from.position + way * direction;
        return guest.contacts_at(at, margin);
    };
    double way = 0, before = 0;
    for (int i = 0; i < kMostAdvances && way <= length; ++i) {
        const std::vector<Contact>* contacts = &contacts_after(way);
        for (int k = 0; k < kHalvings && overlaps_by(*contacts, kDeep * size); ++k)
            contacts = &contacts_after(way = 0.5 * (before + way));
        const Bound bound = least_way(*contacts, direction, closed, margin);
        if (bound.contact && (bound.advance == 0 || i + 1 == kMostAdvances))
            return hit(*bound.contact, way);
        before = way;
        way += bound.advance;
    }
    guest.leave();
    return std::nullopt;
}

}  // namespace plumb
