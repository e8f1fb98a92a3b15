// SPDX-License-Identifier: MIT
#include "islands/island_columns.h"

#include "constraints/connector.h"
#include "constraints/friction.h"
#include "contacts/anchors.h"
#include "islands/island_solver.h"
#include "math/rotation.h"
#include "ties/joint_geometry.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// A bound on the greatest eigenvalue: the greatest sum of a row.
double largest(const Symmetric3<double>& k) {
    const double xy = std::abs(k.xy), xz = std::abs(k.xz), yz = std::abs(k.yz);
    return std::max({k.xx + xy + xz, k.yy + xy + yz, k.zz + xz + yz});
}

bool does_stick(const IslandPoint& p) {
    return plumb::does_stick(p.impulse[0], p.impulse.segment<2>(1).squaredNorm(), p.cone.friction);
}

}  // namespace

IslandColumns::IslandColumns(const Plan& plan)
    : has_friction(plan.runs(Effect::friction)),
      resists_rolling(plan.runs(Effect::turning_friction)) {}

void IslandColumns::clear() {
    bodies.clear(), ties.clear();
    contacts.clear(), points.clear(), locked.clear(), opening.clear(), parting.clear();
}

void IslandColumns::add_point(const World& world, std::uint32_t contact, std::uint32_t a,
                              std::uint32_t b) {
    const Vector3d n = to_eigen(world.contacts.found[contact].normal), x = tangent_of<double>(n);
    contacts.push_back(contact);
    IslandPoint& p = points.emplace_back();
    locked.push_back(0), opening.push_back(0), parting.push_back(0);
    p.a = a, p.b = b;
    p.frame << n, x, n.cross(x);
    p.length = 1;
    p.impulse.setZero();
}

void IslandColumns::size_velocities() {
    for (auto* column : {&start, &velocity, &shift, &sum}) column->resize(bodies.size());
}

/// Sweeps cannot take back what a press left in others.
void IslandColumns::take_memory(const World& world, const ExactIsland& island) {
    const bool swept = island.effort == IslandEffort::swept;
    for (std::uint32_t k = island.first_point; k < island.last_point; ++k) {
        const ContactMemory& memory = world.contacts.memory[contacts[k]];
        IslandPoint& p = points[k];
        if (!memory.matched || (swept && !memory.exact)) continue;
        p.impulse.head<3>() = p.frame.transpose() * memory.friction_impulse;
        p.impulse[0] = memory.normal_impulse;
        if (p.cone.turns())
            p.impulse.tail<3>() = p.frame.transpose() * memory.rolling_impulse / p.length;
    }
}

void IslandColumns::take_geometry(const World& world) {
    const Bodies& all = world.bodies;
    for (SolvedBody& body : bodies) {
        body.mass = all.mass[body.body];
        body.inverse_inertia = all.world_inverse_inertia[body.body];
        body.inertia =
            rotated_diagonal(all.orientation[body.body].toRotationMatrix(), all.inertia[body.body]);
    }
    for (std::size_t k = 0; k < points.size(); ++k) take_geometry(world, points[k], contacts[k]);
}

void IslandColumns::take_geometry(const World& world, IslandPoint& p, std::uint32_t contact) const {
    const Contact& c = world.contacts.found[contact];
    const SurfacePair& surface = world.surface_pair(c.a, c.b);
    const Vector3d n = p.frame.col(0), at = world.contacts.point[contact];
    p.arm_a = at - world.bodies.position[c.a];
    p.arm_b = at - world.bodies.position[c.b];
    const InverseMass<double> of_a = inverse_mass(world.bodies, c.a),
                              of_b = inverse_mass(world.bodies, c.b);
    p.mass = 1 / largest(point_response(of_a, p.arm_a) + point_response(of_b, p.arm_b));
    p.mass_normal = 1 / (response(of_a, p.arm_a, n, n) + response(of_b, p.arm_b, n, n));
    const double before = p.length;
    p.length = std::sqrt(1 / (largest(of_a.inertia + of_b.inertia) * p.mass));
    p.impulse.tail<3>() *= before / p.length;  // the torque stays
    p.cone = {};
    if (has_friction) p.cone.friction = surface.friction;
    if (!resists_rolling) return;
    p.cone.spinning = surface.spinning_friction / p.length;
    p.cone.rolling = surface.rolling_friction / p.length;
}

void IslandColumns::take_velocities(const World& world, double substep) {
    h = substep;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const std::uint32_t body = bodies[i].body;
        start[i] << world.bodies.velocity[body], world.bodies.angular_velocity[body];
        velocity[i] = start[i];
        shift[i].setZero();
    }
}

void IslandColumns::forget_impulses() {
    for (IslandPoint& p : points) p.impulse.setZero();
    for (TieRow& row : ties.rows()) row.impulse = 0;
}

void IslandColumns::apply_impulses(const ExactIsland& island) {
    const Island all = all_of(island);
    const std::span<Vector6d> sums = bodies_in(sum, island);
    std::fill(sums.begin(), sums.end(), Vector6d::Zero());
    for (const IslandPoint& point : all.points) add_impulse(point, point.impulse, sums);
    for (const TieRow& row : all.rows) add_impulse(row, row.impulse, sums);
    for (std::size_t i = 0; i < sums.size(); ++i)
        all.velocity[i] += response(all.bodies[i], sums[i]);
    forget_what_whirls(island);
}

/// Impulses of the substep before take the push of gravity back where nothing changed. What joints
/// bore when a robot landed would whirl its links about, once its feet are off the ground, farther
/// than what joints are asked for at the end of the substep means anything: such are no start,
/// unless bodies turn more than half as fast without.
void IslandColumns::forget_what_whirls(const ExactIsland& island) {
    if (island.ties.empty() || island.is_meshed || island.is_driven) return;
    const Island all = all_of(island);
    const std::span<const Vector6d> begin = bodies_in(start, island);
    const auto rate = [](const Vector6d& v) { return v.tail<3>().norm(); };
    for (std::size_t i = 0; i < begin.size(); ++i) {
        const double now = rate(all.velocity[i]);
        if (h * now <= kTrustedTurn || now <= 2 * rate(begin[i])) continue;
        IslandSolver::forget(all);
        std::copy(begin.begin(), begin.end(), all.velocity.begin());
        return;
    }
}

void IslandColumns::give_changes(Bodies& all) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const std::uint32_t body = bodies[i].body;
        const Vector6d change = velocity[i] - start[i];
        all.velocity[body] += change.head<3>();
        all.turn_change[body] = change.tail<3>();
        all.angular_velocity[body] += change.tail<3>();
    }
}

bool IslandColumns::shifts(const ExactIsland& island) const {
    const std::span<const Vector6d> all = bodies_in(shift, island);
    return std::any_of(all.begin(), all.end(), [](const Vector6d& s) { return !s.isZero(0); });
}

void IslandColumns::give_shifts(Bodies& all, const ExactIsland& island) const {
    for (std::uint32_t i = island.first_body; i < island.last_body; ++i) {
        if (shift[i].isZero(0)) continue;
        const std::uint32_t body = bodies[i].body;
        all.position[body] += h * shift[i].head<3>();
        all.orientation[body] = turned(all.orientation[body], Vector3d(h * shift[i].tail<3>()));
    }
}

void IslandColumns::add_impulses(ContactSums& sums) const {
    for (std::size_t k = 0; k < points.size(); ++k)
        sums.add(contacts[k], points[k].impulse[0], friction_of(points[k]));
}

void IslandColumns::store_impulses(ContactTable& table) const {
    for (std::size_t k = 0; k < points.size(); ++k) {
        const IslandPoint& p = points[k];
        ContactMemory& memory = table.memory[contacts[k]];
        memory.normal_impulse = p.impulse[0];
        memory.friction_impulse = friction_of(p);
        memory.rolling_impulse = p.length * (p.frame * p.impulse.tail<3>());
        memory.exact = true;
        memory.jammed = locked[k] != 0;
        memory.gap = table.found[contacts[k]].gap;
        memory.sticks = does_stick(p);
    }
}

}  // namespace plumb
