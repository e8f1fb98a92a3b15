// SPDX-License-Identifier: MIT
#include "solve/elastic_contacts.h"

#include "constraints/contact.h"
#include "contacts/anchors.h"
#include "contacts/contact_measures.h"
#include "math/matrices.h"
#include "world/point_place.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// ρ is so many times what the points of a contact resist a push with, of two bodies the heavier
/// one: more rounds are needed with less, and more digits are lost with more.
constexpr double kFirm = 5;

}  // namespace

void ElasticContacts::weigh(const SparseLdlt& system) {
    resistance_.resize(system.rows());
    for (std::uint32_t i = 0; i < system.rows(); ++i)
        resistance_[i] = system.diagonal(i).trace() / 3;
}

void ElasticContacts::begin(const World& world, double h, double stiffness, double recovery) {
    const Bodies& b = world.bodies;
    const Particles& p = world.particles;
    for (Body& body : bodies_) {
        body.table_row = b.row[body.index];
        body.inverse = {b.inverse_mass[body.index], b.world_inverse_inertia[body.index]};
        body.mass = 1 / body.inverse.mass;
        body.inertia = matrix_of(inverse(body.inverse.inertia));
        body.size = std::sqrt(body.inertia.trace() / body.mass);
    }
    for (Contact& c : contacts_) {
        Vector3d place = Vector3d::Zero();
        double yields = 0, of_body[2] = {0, 0}, gap = 0;
        for (std::uint32_t k = 0; k < c.points; ++k) {
            place += c.weight[k] * p.position[c.particle[k]];
            if (p.inverse_mass[c.particle[k]] > 0)
                yields += c.weight[k] * c.weight[k] / resistance_[c.particle[k]];
        }
        if (c.of == Source::bodies) {
            place = world.contacts.point[c.source];
            gap = gap_to_solve_for(world, c.source, recovery);
        } else if (c.of == Source::surface) {
            const SurfaceContact& found = world.surface_contacts[c.source];
            const Vector3d apart =
                c.is_between_particles()
                    ? place
                    : place - in_world(b, found.point.body, found.point.position);
            gap = c.normal.dot(apart) - found.distance;
        } else {
            const plumb::Contact& found = world.particle_contacts.found[c.source];
            gap = c.normal.dot(place -
                               in_world(b, found.b, world.particle_contacts.track[c.source])) -
                  found.radius_a - found.radius_b;
        }
        // what may be left of an overlap at the end
        const double left = overlap_left(gap, recovery);
        const double rest = left + (1 - stiffness) * (std::min(gap, 0.0) - left);
        c.given = (gap - rest) / h * c.normal;
        if (c.of == Source::bodies) begin_bodies(world, h, c);
        for (int i = 0; i < 2; ++i) {
            Side& side = c.sides[i];
            if (side.index == kNoIndex) continue;
            side.arm = place - b.position[side.index];
            if (side.body == kNoIndex)
                c.given += kSign[i] *
                           velocity_at<double>(
                               {b.velocity[side.index], b.angular_velocity[side.index]}, side.arm);
            else
                of_body[i] =
                    response<double>(bodies_[side.body].inverse, side.arm, c.normal, c.normal);
        }
        // a light body under a heavy one bears its weight
        if (of_body[0] > 0 && of_body[1] > 0)
            yields = std::min(of_body[0], of_body[1]);
        else
            yields += of_body[0] + of_body[1];
        c.rho = yields > 0 ? kFirm / yields : 0;
        c.applied.setZero();
    }
}

/// What contacts of bodies ask besides: that they bounce, that friction pulls back to where it
/// began to stick, and that velocities are those over the whole substep.
void ElasticContacts::begin_bodies(const World& world, double h, Contact& c) const {
    const ContactTable& table = world.contacts;
    const double bounce = restitution_velocity_of(table, c.source);
    if (bounce > 0) c.given = -bounce * c.normal;
    if (!table.anchor_slip.empty()) {
        const Vector3d& slip = table.anchor_slip[c.source];
        c.given += world.settings.anchor_stiffness / h * (slip - slip.dot(c.normal) * c.normal);
    }
    if (!table.bend.empty()) c.given += table.bend[c.source];
}

void ElasticContacts::find_targets(std::vector<Vector3d>& v, std::vector<Vector3d>& target,
                                   const ElasticTies& ties) const {
    for (const Body& body : bodies_) {
        v[body.row] = target[body.row] = body.v.v;
        v[body.row + 1] = target[body.row + 1] = body.v.w;
    }
    for (const Contact& c : contacts_)
        for (int i = 0; i < 2; ++i) {
            const Side& side = c.sides[i];
            if (side.body == kNoIndex) continue;
            const Body& body = bodies_[side.body];
            Velocity<double> without{target[body.row], target[body.row + 1]};
            apply_impulse<double>(without, body.inverse, side.arm, -kSign[i] * c.applied);
            target[body.row] = without.v, target[body.row + 1] = without.w;
        }
    for (std::size_t i = 0; i < ties.rows().size(); ++i)
        for (const RowSide& side : ties.rows()[i].sides()) {
            if (ties.particle(side.body) != kNoIndex) continue;
            const Body& body = bodies_[side.body];
            const Velocity<double> change = change_by(body, -ties.applied()[i] * side.on);
            target[body.row] += change.v, target[body.row + 1] += change.w;
        }
}

void ElasticContacts::gather(const std::vector<Vector3d>& rows,
                             std::vector<Vector6d>& of_bodies) const {
    of_bodies.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        of_bodies[i] << rows[bodies_[i].row], rows[bodies_[i].row + 1];
}

void ElasticContacts::add_to_rows(const std::vector<Vector6d>& of_bodies,
                                  std::vector<Vector3d>& rows) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        rows[bodies_[i].row] += of_bodies[i].head<3>();
        rows[bodies_[i].row + 1] += of_bodies[i].tail<3>();
    }
}

double ElasticContacts::add_forces(const std::vector<Vector3d>& target,
                                   const std::vector<Vector3d>& v, std::vector<Vector3d>& force) {
    double energy = 0;
    for (const Body& body : bodies_) {
        const Vector3d missing = target[body.row] - v[body.row],
                       turn = target[body.row + 1] - v[body.row + 1];
        force[body.row] = body.mass * missing, force[body.row + 1] = body.inertia * turn;
        energy += 0.5 * (missing.dot(force[body.row]) + turn.dot(force[body.row + 1]));
    }
    for (Contact& c : contacts_) {
        c.u = c.given + velocity_of(c, v);
        find_force(c.u, c, energy);
        for (std::uint32_t k = 0; k < c.points; ++k) force[c.particle[k]] += c.weight[k] * c.q;
        for (int i = 0; i < 2; ++i) {
            if (c.sides[i].body == kNoIndex) continue;
            const std::uint32_t row = bodies_[c.sides[i].body].row;
            force[row] += kSign[i] * c.q;
            force[row + 1] += kSign[i] * c.sides[i].arm.cross(c.q);
        }
    }
    return energy;
}

/// Of the first side's point against that of the second, without what is given.
Vector3d ElasticContacts::velocity_of(const Contact& c, const std::vector<Vector3d>& v) const {
    Vector3d u = Vector3d::Zero();
    for (std::uint32_t k = 0; k < c.points; ++k) u += c.weight[k] * v[c.particle[k]];
    for (int i = 0; i < 2; ++i) {
        if (c.sides[i].body == kNoIndex) continue;
        const std::uint32_t row = bodies_[c.sides[i].body].row;
        u += kSign[i] * velocity_at<double>({v[row], v[row + 1]}, c.sides[i].arm);
    }
    return u;
}

void ElasticContacts::begin_line(const std::vector<Vector3d>& way) {
    for (Contact& c : contacts_) c.way = velocity_of(c, way);
}

double ElasticContacts::push_along(double share) const {
    double sum = 0;
    for (const Contact& c : contacts_) {
        if (c.rho == 0) continue;
        const Vector3d wish = c.p - c.rho * (c.u + share * c.way);
        const double pull = wish.dot(c.normal);
        const Vector3d across = wish - pull * c.normal;
        const double size = across.norm(), most = c.friction * std::max(0.0, c.p.dot(c.normal));
        sum += std::max(0.0, pull) * c.normal.dot(c.way);
        sum += (size > most ? most / size : 1) * across.dot(c.way);
    }
    return sum;
}

void ElasticContacts::find_force(const Vector3d& u, Contact& c, double& energy) const {
    c.q.setZero();
    if (c.rho == 0) return;
    const Vector3d wish = c.p - c.rho * u;
    const double pull = wish.dot(c.normal), along = std::max(0.0, pull);
    const Vector3d across = wish - pull * c.normal;
    const double size = across.norm(), most = c.friction * std::max(0.0, c.p.dot(c.normal));
    c.slides = size >= most, c.held = c.slides && size > 0 ? most / size : 1;
    c.q = along * c.normal + c.held * across;
    const double friction = size > most ? 2 * most * size - most * most : size * size;
    energy += (along * along + friction) / (2 * c.rho);
}

void ElasticContacts::list_stiffness(KeptFactors& made_of) const {
    made_of.bodies.clear(), made_of.contacts.clear();
    for (const Body& body : bodies_)
        made_of.bodies.push_back({body.index, body.mass, body.inertia});
    for (const Contact& c : contacts_) {
        if (c.q.isZero(0)) continue;
        const double along = c.q.dot(c.normal);
        const Vector3d across = c.q - along * c.normal;
        const double size = across.norm();
        const Matrix3d n = c.normal * c.normal.transpose();
        Matrix3d d = (along > 0 ? c.rho : 0.0) * n;
        if (!c.slides)
            d += c.rho * (Matrix3d::Identity() - n);
        else if (size > 0)
            // along its way what slides is not held, across it as a force that turns with it
            d += c.rho * c.held *
                 (Matrix3d::Identity() - n - across * across.transpose() / (size * size));
        made_of.contacts.push_back({c.points,
                                    {c.particle[0], c.particle[1], c.particle[2], c.particle[3]},
                                    {c.weight[0], c.weight[1], c.weight[2], c.weight[3]},
                                    {c.sides[0].body, c.sides[1].body},
                                    {c.sides[0].arm, c.sides[1].arm},
                                    d});
    }
}

bool ElasticContacts::has_bodies_of(const KeptFactors& made_of) const {
    return std::equal(bodies_.begin(), bodies_.end(), made_of.bodies.begin(), made_of.bodies.end(),
                      [](const Body& x, const KeptFactors::Body& y) { return x.index == y.index; });
}

double ElasticContacts::driven_energy() const {
    double energy = 0;
    for (const Contact& c : contacts_) {
        const double along = c.given.dot(c.normal);
        const Vector3d across = c.given - along * c.normal;
        energy += 0.5 * c.rho * (across.squaredNorm() + (along < 0 ? along * along : 0));
    }
    return energy;
}

void ElasticContacts::forget() {
    for (Contact& c : contacts_) c.p.setZero(), c.q.setZero();
}

void ElasticContacts::let_go() {
    for (Contact& c : contacts_) c.rho = 0;
}

double ElasticContacts::take_forces() {
    double most = 0;
    for (Contact& c : contacts_) {
        if (c.rho > 0) most = std::max(most, (c.p - c.q).norm() / c.rho);
        c.p = c.q;
    }
    return most;
}

void ElasticContacts::store(World& world) const {
    world.elastic_impulses.clear();
    world.elastic_impulses.reserve(contacts_.capacity());
    for (const ElasticImpulse& key : keys_) {
        world.elastic_impulses.push_back(key);
        world.elastic_impulses.back().impulse = contacts_[key.order].p;
    }
    for (const Contact& c : contacts_) {
        if (c.of != Source::bodies) continue;
        const double along = c.applied_along();
        const Vector3d across = c.applied_across();
        ContactMemory& memory = world.contacts.memory[c.source];
        remember_impulse(memory, along, across);
        memory.missed = 0;
        memory.sticks = does_stick(along, across.squaredNorm(), c.friction);
    }
}

}  // namespace plumb
