// SPDX-License-Identifier: MIT
/// Contacts are detected once a step; through its substeps their points ride on the bodies.
#include "step/stages.h"

namespace plumb {
namespace {

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
        take_gaps_as_found(world);
    else
        measure_gaps(world);
    if (plan.runs(Effect::sticking_anchors)) measure_drifts(world);
}

}  // namespace plumb
