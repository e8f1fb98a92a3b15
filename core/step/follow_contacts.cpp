// SPDX-License-Identifier: MIT
/// Contacts are detected once a step; through its substeps their points ride on the bodies.
#include "step/rims.h"
#include "step/stages.h"

namespace plumb {
namespace {

/// A contact has rolled on once its point has come farther than this share of the rim's radius
/// along both bodies.
constexpr double kRolledOn = 1e-3;

Vector3d in_body(const Bodies& b, std::uint32_t i, const Vector3d& point) {
    return b.orientation[i].conjugate() * (point - b.position[i]);
}
Vector3d in_world(const Bodies& b, std::uint32_t i, const Vector3d& point) {
    return b.position[i] + b.orientation[i] * point;
}

void take_gaps_as_found(World& world) {
    ContactTable& c = world.contacts;
    c.gap.resize(c.found.size());
    for (std::size_t i = 0; i < c.found.size(); ++i) c.gap[i] = c.found[i].gap;
    if (world.settings.substeps == 1) return;
    c.track.resize(c.found.size());
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Contact& contact = c.found[i];
        c.track[i] = {in_body(world.bodies, contact.a, to_eigen(contact.point_a)),
                      in_body(world.bodies, contact.b, to_eigen(contact.point_b))};
    }
}

/// gap = n·(a − b) − radii, at the poses now.
void measure_gaps(World& world) {
    ContactTable& c = world.contacts;
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Contact& contact = c.found[i];
        const Vector3d apart = in_world(world.bodies, contact.a, c.track[i].a) -
                               in_world(world.bodies, contact.b, c.track[i].b);
        c.gap[i] = to_eigen(contact.normal).dot(apart) - contact.radius_a - contact.radius_b;
    }
}

/// The point of a rim where its contact is now, in the world [m].
Vector3d point_on_rim(const Bodies& b, const Contact& contact, const ContactRim& at) {
    const Vector3d n = to_eigen(contact.normal);
    const bool of_a = at.body == contact.a;
    const Vector3d outward = b.orientation[at.body].conjugate() * (of_a ? Vector3d(-n) : n);
    const Vector3d found = to_eigen(of_a ? contact.point_a : contact.point_b);
    return in_world(b, at.body, farthest_on(at.rim, outward, in_body(b, at.body, found)));
}

/// Points that a rim has rolled away from do not hold it any more: it sticks where it is now.
void let_go_of_what_rolled(World& world, std::size_t i) {
    const Contact& contact = world.contacts.found[i];
    const ContactRim& at = world.contacts.rims[i];
    if (at.rim.radius == 0) return;
    const Bodies& b = world.bodies;
    ContactMemory& m = world.contacts.memory[i];
    const Vector3d n = to_eigen(contact.normal), now = point_on_rim(b, contact, at);
    const double far = kRolledOn * at.rim.radius;
    for (const Vector3d& was :
         {in_world(b, contact.a, m.stick_a), in_world(b, contact.b, m.stick_b)})
        if ((now - was).cross(n).squaredNorm() < far * far) return;
    m.stick_a = in_body(b, contact.a, now);
    m.stick_b = in_body(b, contact.b, now);
}

/// How far apart the points have come that met when a contact began to stick.
void measure_drifts(World& world) {
    ContactTable& c = world.contacts;
    c.drift.assign(c.found.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Contact& contact = c.found[i];
        if (!is_sharp(contact)) continue;
        let_go_of_what_rolled(world, i);
        c.drift[i] = in_world(world.bodies, contact.a, c.memory[i].stick_a) -
                     in_world(world.bodies, contact.b, c.memory[i].stick_b);
    }
}

}  // namespace

void follow_contacts(World& world, const Plan& plan, bool first_substep) {
    if (first_substep) {
        take_gaps_as_found(world);
        find_rims(world);
    } else {
        follow_rims(world);
        measure_gaps(world);
    }
    if (plan.runs(Effect::sticking_anchors)) measure_drifts(world);
}

}  // namespace plumb
