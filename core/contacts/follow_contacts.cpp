// SPDX-License-Identifier: MIT
/// Contacts are detected once a step; through its substeps their points ride on the bodies, and
/// with them the gap and the common point at which the contact acts. Only a point of now keeps
/// angular momentum: arms of the step's beginning would turn the bodies about where they have been.
#include "contacts/anchors.h"
#include "contacts/contact_stages.h"
#include "contacts/pair_poses.h"
#include "contacts/rims.h"

#include <algorithm>

namespace plumb {
namespace {

/// A contact has rolled on once its point has come farther than this share of the rim's radius
/// along both bodies.
constexpr double kRolledOn = 1e-3;

/// What is no faster along a surface than gravity makes it in this share of a substep creeps;
/// anything faster slides, and without gravity nothing creeps.
constexpr double kCreeps = 0.1;

/// How far what creeps comes in a substep [m].
double creep_in(const Settings& settings) {
    const double h = settings.dt / settings.substeps;
    return kCreeps * h * h * settings.gravity.norm();
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

void take_as_found(World& world, Workers& workers) {
    ContactTable& c = world.contacts;
    const bool rides = world.settings.substeps > 1;
    c.gap.resize(c.found.size());
    c.point.resize(c.found.size());
    if (rides) c.track.resize(c.found.size());
    workers.each(c.pairs.size(), [&](std::uint32_t p, std::uint32_t) {
        const ContactPair& pair = c.pairs[p];
        for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
            c.gap[i] = c.found[i].gap;
            c.point[i] = common_point(c.found[i]);
        }
        if (!rides) return;
        const PairPoses poses(c.frames, pair.a, pair.b);
        for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i)
            c.track[i] = {poses.in_a(to_eigen(c.found[i].point_a)),
                          poses.in_b(to_eigen(c.found[i].point_b)),
                          share_of_a(world.bodies, c.found[i])};
    });
}

/// gap = n·(a − b) − radii at the poses now, and the common point: along the normal half-way
/// between the surfaces.
void measure(World& world, Workers& workers) {
    ContactTable& c = world.contacts;
    workers.each(c.pairs.size(), [&](std::uint32_t p, std::uint32_t) {
        const ContactPair& pair = c.pairs[p];
        const PairPoses poses(c.frames, pair.a, pair.b);
        for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
            const Contact& contact = c.found[i];
            const Vector3d n = to_eigen(contact.normal);
            const Vector3d a = poses.a_in_world(c.track[i].a) - contact.radius_a * n,
                           b = poses.b_in_world(c.track[i].b) + contact.radius_b * n;
            const Vector3d apart = a - b;
            c.gap[i] = n.dot(apart);
            const double lead = c.track[i].share - 0.5;
            c.point[i] = 0.5 * (a + b) + lead * (apart - c.gap[i] * n);
        }
    });
}

/// Points that a rim has rolled away from do not hold it any more: it sticks where it is now.
void let_go_of_what_rolled(World& world, const PairPoses& poses, std::size_t i) {
    const ContactTable& c = world.contacts;
    const Contact& contact = c.found[i];
    if (!c.rims[i].runs) return;
    const double far = kRolledOn * c.rims[i].rim.radius;
    ContactMemory& m = world.contacts.memory[i];
    const Vector3d n = to_eigen(contact.normal), &now = c.point[i];
    for (const Vector3d& was : {poses.a_in_world(m.stick_a), poses.b_in_world(m.stick_b)})
        if ((now - was).cross(n).squaredNorm() < far * far) return;
    set_anchors(m, poses, now, Vector3d::Zero());
}

/// How far apart the points have come that met when a contact began to stick. What has slid in the
/// substep before took them along, or those of the step's beginning would pull back what comes to a
/// stand after them. How far it had crept until then is not forgotten.
void measure_anchor_slips(World& world, Workers& workers, bool first_substep) {
    ContactTable& c = world.contacts;
    if (first_substep) c.anchor_slip.assign(c.found.size(), Vector3d::Zero());
    const double creep = creep_in(world.settings);
    const auto slid = [creep](const Vector3d& way, const Vector3d& normal) {
        return way.cross(normal).squaredNorm() > creep * creep;
    };
    workers.each(c.pairs.size(), [&](std::uint32_t p, std::uint32_t) {
        const ContactPair& pair = c.pairs[p];
        const auto first = c.found.begin() + pair.first;
        if (std::none_of(first, first + pair.count, is_sharp)) return;
        const PairPoses poses(c.frames, pair.a, pair.b);
        for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
            if (!is_sharp(c.found[i])) continue;
            const Vector3d before = c.anchor_slip[i], n = to_eigen(c.found[i].normal);
            if (!first_substep && slid(anchor_slip_of(poses, c.memory[i]) - before, n))
                set_anchors(c.memory[i], poses, c.point[i], before);
            if (!c.rims.empty()) let_go_of_what_rolled(world, poses, i);
            c.anchor_slip[i] = anchor_slip_of(poses, c.memory[i]);
        }
    });
}

}  // namespace

void follow_contacts(World& world, const Plan& plan, Workers& workers, bool first_substep) {
    const bool rims = plan.runs(Effect::rims);
    std::vector<BodyFrame>& frames = world.contacts.frames;
    // those of the first substep are known where contacts were matched
    const bool are_known = first_substep && frames.size() == world.bodies.size();
    if (!world.contacts.found.empty() && !are_known) find_frames(world.bodies, frames, workers);
    if (first_substep) {
        take_as_found(world, workers);
        rims ? find_rims(world) : forget_rims(world);
    } else {
        if (rims) follow_rims(world);
        measure(world, workers);
    }
    if (plan.runs(Effect::sticking_anchors)) measure_anchor_slips(world, workers, first_substep);
}

}  // namespace plumb
