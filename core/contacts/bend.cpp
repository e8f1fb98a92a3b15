// SPDX-License-Identifier: MIT
#include "contacts/bend.h"

#include "contacts/rims.h"
#include "math/rotation.h"

namespace plumb {
namespace {

/// A body that turns by less than this in a substep keeps its points on straight lines [rad].
constexpr double kStill = 1e-5;

/// Mean velocity over a substep, less that at its start, of what turns with a body from r on.
Vector3d bend_of(const Vector3d& w, const Vector3d& r, double h) {
    const Vector3d turn = h * w;
    if (turn.squaredNorm() < kStill * kStill) return Vector3d::Zero();
    return (exponential_map(turn) * r - r) / h - w.cross(r);
}

/// Of the points of a contact that ride on their bodies, a's less b's.
Vector3d bend_of_material(const World& world, std::size_t contact, double h) {
    const ContactTable& c = world.contacts;
    const Contact& found = c.found[contact];
    const Bodies& b = world.bodies;
    const bool rides = world.settings.substeps > 1;  // else the points are where they were found
    const Vector3d a_point =
                       rides ? in_world(b, found.a, c.track[contact].a) : to_eigen(found.point_a),
                   b_point =
                       rides ? in_world(b, found.b, c.track[contact].b) : to_eigen(found.point_b);
    return bend_of(b.angular_velocity[found.a], a_point - b.position[found.a], h) -
           bend_of(b.angular_velocity[found.b], b_point - b.position[found.b], h);
}

bool is_turntable(const Bodies& b, std::uint32_t body) {
    return b.motion[body] == Motion::kinematic && !b.angular_velocity[body].isZero(0);
}

/// Of the point of what a rim stands on, if that turns.
Vector3d bend_of_turntable(const World& world, std::size_t contact, double h) {
    const Bodies& b = world.bodies;
    const bool of_a = world.contacts.rims[contact].body != world.contacts.found[contact].a;
    const std::uint32_t body =
        of_a ? world.contacts.found[contact].a : world.contacts.found[contact].b;
    if (!is_turntable(b, body)) return Vector3d::Zero();
    return (of_a ? 1 : -1) *
           bend_of(b.angular_velocity[body], world.contacts.point[contact] - b.position[body], h);
}

/// Whether what moves of a contact touches nothing but what is fixed.
bool is_on_ground(const Bodies& b, const GroundTouch& ground, const ContactPair& c) {
    return ground.is_alone(b.motion[c.a] == Motion::dynamic ? c.a : c.b);
}

}  // namespace

void foresee_bend(World& world, const GroundTouch& ground, const Plan& plan, Workers& workers,
                  double h) {
    ContactTable& c = world.contacts;
    if (!world.settings.shared_push) {
        c.bend.clear();
        return;
    }
    const bool rims = plan.runs(Effect::rims);
    c.bend.resize(c.found.size());
    workers.each(c.pairs.size(), [&](std::uint32_t p, std::uint32_t) {
        const ContactPair& pair = c.pairs[p];
        const bool rides = is_on_ground(world.bodies, ground, pair) ||
                           is_turntable(world.bodies, pair.a) || is_turntable(world.bodies, pair.b);
        for (std::uint32_t i = pair.first; i < pair.first + pair.count; ++i) {
            const bool carried = rides && c.memory[i].matched && c.memory[i].normal_impulse > 0;
            if (rims && c.rims[i].rim.radius > 0)
                c.bend[i] = bend_at_rim(world, i, h) + bend_of_turntable(world, i, h);
            else
                c.bend[i] = carried ? bend_of_material(world, i, h) : Vector3d(Vector3d::Zero());
        }
        if (rims) leave_to_rolling(world, pair, h);
    });
}

}  // namespace plumb
