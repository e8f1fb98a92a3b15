// SPDX-License-Identifier: MIT
/// Contacts are detected once a step; through its substeps their points ride on the bodies, and
/// with them the gap and the common point at which the contact acts. Only a point of now keeps
/// angular momentum: arms of the step's beginning would turn the bodies about where they have been.
#include "step/stages.h"

namespace plumb {
namespace {

Vector3d in_body(const Bodies& b, std::uint32_t i, const Vector3d& point) {
    return b.orientation[i].conjugate() * (point - b.position[i]);
}
Vector3d in_world(const Bodies& b, std::uint32_t i, const Vector3d& point) {
    return b.position[i] + b.orientation[i] * point;
}

/// Where two points of a contact slide past each other, it goes with that of the body that touches
/// with a point: with what moves along what does not, with what is round along what is sharp, with
/// the rounder of two that are round; half-way where nobody can tell.
double share_of_a(const Bodies& b, const Contact& c) {
    const bool moves_a = b.motion[c.a] == Motion::dynamic,
               moves_b = b.motion[c.b] == Motion::dynamic;
    if (moves_a != moves_b) return moves_a ? 1 : 0;
    if (c.radius_a > 0 && c.radius_b > 0) return c.radius_b / (c.radius_a + c.radius_b);
    return is_sharp(c) ? 0.5 : c.radius_a > 0 ? 1 : 0;
}

void take_as_found(World& world) {
    ContactTable& c = world.contacts;
    c.gap.resize(c.found.size());
    c.point.resize(c.found.size());
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        c.gap[i] = c.found[i].gap;
        c.point[i] = common_point(c.found[i]);
    }
    if (world.settings.substeps == 1) return;
    c.track.resize(c.found.size());
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Contact& contact = c.found[i];
        c.track[i] = {in_body(world.bodies, contact.a, to_eigen(contact.point_a)),
                      in_body(world.bodies, contact.b, to_eigen(contact.point_b)),
                      share_of_a(world.bodies, contact)};
    }
}

/// gap = n·(a − b) − radii at the poses now, and the common point: along the normal half-way
/// between the surfaces.
void measure(World& world) {
    ContactTable& c = world.contacts;
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Contact& contact = c.found[i];
        const Vector3d n = to_eigen(contact.normal);
        const Vector3d a = in_world(world.bodies, contact.a, c.track[i].a) - contact.radius_a * n,
                       b = in_world(world.bodies, contact.b, c.track[i].b) + contact.radius_b * n;
        const Vector3d apart = a - b;
        c.gap[i] = n.dot(apart);
        const double lead = c.track[i].share - 0.5;
        c.point[i] = 0.5 * (a + b) + lead * (apart - c.gap[i] * n);
    }
}

/// How far apart the points have come that met when a contact began to stick.
void measure_drifts(World& world) {
    ContactTable& c = world.contacts;
    c.drift.assign(c.found.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Contact& contact = c.found[i];
        if (!is_sharp(contact)) continue;
        c.drift[i] = in_world(world.bodies, contact.a, c.memory[i].stick_a) -
                     in_world(world.bodies, contact.b, c.memory[i].stick_b);
    }
}

}  // namespace

void follow_contacts(World& world, const Plan& plan, bool first_substep) {
    if (first_substep)
        take_as_found(world);
    else
        measure(world);
    if (plan.runs(Effect::sticking_anchors)) measure_drifts(world);
}

}  // namespace plumb
