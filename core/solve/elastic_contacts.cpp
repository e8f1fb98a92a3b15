// SPDX-License-Identifier: MIT
#include "solve/elastic_contacts.h"

#include "constraints/contact.h"
#include "math/matrices.h"
#include "world/point_place.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// ρ is so many times what the points of a contact resist a push with: more rounds are needed with
/// less, and more digits are lost with more.
constexpr double kFirm = 3;

/// Directions in which the points of a body can push it: by eigenvalues against the greatest.
constexpr double kWithinReach = 1e-6;

/// Points of a surface that no element has in common are held no less than the whole.
void add_between(std::uint32_t i, std::uint32_t j, const Matrix3d& block, SparseLdlt& system) {
    if (const auto slot = system.find_slot(i, j)) return system.add(*slot, block);
    system.add(i, block), system.add(j, block);
}

}  // namespace

bool ElasticContacts::load(const World& world, std::uint32_t first_row) {
    const Bodies& b = world.bodies;
    bodies_.clear(), contacts_.clear();
    contacts_.reserve(world.particle_contacts.found.capacity() + world.surface_contacts.capacity());
    bodies_.reserve(b.size());
    std::swap(pairs_, pairs_before_);
    pairs_.clear();
    body_of_.assign(b.size(), kNoIndex);
    const auto add = [&](Contact& c, std::uint32_t body) {
        double moves = b.inverse_mass[body];
        for (std::uint32_t k = 0; k < c.points; ++k)
            moves += world.particles.inverse_mass[c.particle[k]];
        if (!(moves > 0)) return;
        c.body = kNoIndex;
        if (b.inverse_mass[body] > 0) {
            if (body_of_[body] == kNoIndex) {
                body_of_[body] = static_cast<std::uint32_t>(bodies_.size());
                Body added;
                added.index = body, added.row = first_row + rows();
                bodies_.push_back(added);
            }
            c.body = body_of_[body];
        }
        if (!has_friction_) c.friction = 0;
        contacts_.push_back(c);
    };
    const ParticleContactTable& table = world.particle_contacts;
    for (std::uint32_t i = 0; i < table.found.size(); ++i) {
        const plumb::Contact& found = table.found[i];
        if (!has_elastic_contacts(world, found.a)) continue;
        Contact c;
        c.source = i, c.particle[0] = found.a;
        c.normal = to_eigen(found.normal);
        c.friction =
            world.surface_of(world.particles.material[found.a], b.material[found.b]).friction;
        add(c, found.b);
    }
    for (std::uint32_t i = 0; i < world.surface_contacts.size(); ++i) {
        const SurfaceContact& found = world.surface_contacts[i];
        if (found.point.body == kNoIndex || !has_elastic_contacts(world, found.triangle[0]))
            continue;
        Contact c;
        c.source = i, c.is_of_surface = true, c.points = 3;
        for (int k = 0; k < 3; ++k)
            c.particle[k] = found.triangle[k], c.weight[k] = found.weights[k];
        c.normal = -found.normal, c.friction = found.friction;
        add(c, found.point.body);
    }
    find_pairs();
    take_kept(world);
    return pairs_ != pairs_before_;
}

/// The pairs of a particle and a body, once for all contacts of theirs.
void ElasticContacts::find_pairs() {
    std::size_t most = 0;
    for (const Contact& c : contacts_) most += 2 * c.points;
    for (auto* pairs : {&pairs_, &pairs_before_})
        if (pairs->capacity() < most) pairs->reserve(2 * most);
    for (const Contact& c : contacts_)
        if (c.body != kNoIndex)
            for (std::uint32_t k = 0; k < c.points; ++k)
                for (std::uint32_t i = 0; i < 2; ++i)
                    pairs_.emplace_back(c.particle[k], bodies_[c.body].row + i);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    for (Contact& c : contacts_)
        if (c.body != kNoIndex)
            for (std::uint32_t k = 0; k < c.points; ++k) {
                const SparseLdlt::Pair pair(c.particle[k], bodies_[c.body].row);
                const auto at = std::lower_bound(pairs_.begin(), pairs_.end(), pair);
                c.pair[k] = static_cast<std::size_t>(at - pairs_.begin());
            }
}

/// p of what touched in the step before.
void ElasticContacts::take_kept(const World& world) {
    keys_.clear();
    keys_.reserve(contacts_.capacity());
    for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
        const Contact& c = contacts_[i];
        if (c.is_of_surface) {
            keys_.push_back({{c.particle[0], c.particle[1], c.particle[2]},
                             world.surface_contacts[c.source].point.body,
                             0,
                             0,
                             i,
                             Vector3d::Zero()});
        } else {
            const plumb::Contact& found = world.particle_contacts.found[c.source];
            keys_.push_back({{found.a, kNoIndex, kNoIndex},
                             found.b,
                             found.part_b,
                             found.feature,
                             i,
                             Vector3d::Zero()});
        }
    }
    std::sort(keys_.begin(), keys_.end());
    auto kept = world.elastic_impulses.begin();
    for (const ElasticImpulse& now : keys_) {
        while (kept != world.elastic_impulses.end() && kept->key() < now.key()) ++kept;
        if (kept == world.elastic_impulses.end()) break;
        if (kept->key() == now.key()) contacts_[now.order].p = (kept++)->impulse;
    }
}

void ElasticContacts::weigh(const SparseLdlt& system, const std::vector<double>& mass) {
    resistance_.assign(mass.size(), 0);
    for (const Contact& c : contacts_)
        for (std::uint32_t k = 0; k < c.points; ++k)
            resistance_[c.particle[k]] = system.diagonal(c.particle[k]).trace() / 3;
}

void ElasticContacts::begin(const World& world, double h, double stiffness, double recovery) {
    const Bodies& b = world.bodies;
    const Particles& p = world.particles;
    for (Body& body : bodies_) {
        body.table_row = b.row[body.index];
        body.inverse = {b.inverse_mass[body.index], b.world_inverse_inertia[body.index]};
        body.mass = 1 / body.inverse.mass;
        body.inertia = matrix_of(inverse(body.inverse.inertia));
    }
    for (Contact& c : contacts_) {
        Vector3d place = Vector3d::Zero(), apart;
        double yields = 0, gap = 0;
        for (std::uint32_t k = 0; k < c.points; ++k) {
            place += c.weight[k] * p.position[c.particle[k]];
            if (p.inverse_mass[c.particle[k]] > 0)
                yields += c.weight[k] * c.weight[k] / resistance_[c.particle[k]];
        }
        std::uint32_t body;
        if (c.is_of_surface) {
            const SurfaceContact& found = world.surface_contacts[c.source];
            body = found.point.body;
            gap = c.normal.dot(place - in_world(b, body, found.point.position)) - found.distance;
        } else {
            const plumb::Contact& found = world.particle_contacts.found[c.source];
            body = found.b;
            gap = c.normal.dot(place - in_world(b, body, world.particle_contacts.track[c.source])) -
                  found.radius_a - found.radius_b;
        }
        c.arm = place - b.position[body];
        // what may be left of an overlap at the end
        const double left = overlap_left(gap, recovery);
        const double rest = left + (1 - stiffness) * (std::min(gap, 0.0) - left);
        c.given = (gap - rest) / h * c.normal;
        if (c.body == kNoIndex)
            c.given -= velocity_at<double>({b.velocity[body], b.angular_velocity[body]}, c.arm);
        else
            yields += response<double>(bodies_[c.body].inverse, c.arm, c.normal, c.normal);
        c.rho = yields > 0 ? kFirm / yields : 0;
        c.applied.setZero();
    }
}

void ElasticContacts::find_targets(std::vector<Vector3d>& v, std::vector<Vector3d>& target) const {
    for (const Body& body : bodies_) {
        v[body.row] = target[body.row] = body.v.v;
        v[body.row + 1] = target[body.row + 1] = body.v.w;
    }
    for (const Contact& c : contacts_) {
        if (c.body == kNoIndex) continue;
        const Body& body = bodies_[c.body];
        Velocity<double> without{target[body.row], target[body.row + 1]};
        apply_impulse<double>(without, body.inverse, c.arm, c.applied);
        target[body.row] = without.v, target[body.row + 1] = without.w;
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
        Vector3d u = c.given;
        for (std::uint32_t k = 0; k < c.points; ++k) u += c.weight[k] * v[c.particle[k]];
        if (c.body != kNoIndex) {
            const std::uint32_t row = bodies_[c.body].row;
            u -= velocity_at<double>({v[row], v[row + 1]}, c.arm);
        }
        find_force(u, c, energy);
        for (std::uint32_t k = 0; k < c.points; ++k) force[c.particle[k]] += c.weight[k] * c.q;
        if (c.body == kNoIndex) continue;
        const std::uint32_t row = bodies_[c.body].row;
        force[row] -= c.q;
        force[row + 1] -= c.arm.cross(c.q);
    }
    return energy;
}

void ElasticContacts::find_force(const Vector3d& u, Contact& c, double& energy) const {
    c.q.setZero();
    if (c.rho == 0) return;
    const Vector3d wish = c.p - c.rho * u;
    const double along = wish.dot(c.normal);
    if (along <= 0) return;
    const Vector3d across = wish - along * c.normal;
    const double size = across.norm(), most = c.friction * along;
    c.slides = size >= most, c.held = c.slides && size > 0 ? most / size : 1;
    c.q = along * c.normal + c.held * across;
    const double friction = size > most ? 2 * most * size - most * most : size * size;
    energy += (along * along + friction) / (2 * c.rho);
}

void ElasticContacts::add_stiffness(const std::vector<double>& mass, std::size_t first_pair,
                                    SparseLdlt& system) const {
    for (const Body& body : bodies_) {
        system.add(body.row, body.mass * Matrix3d::Identity());
        system.add(body.row + 1, body.inertia);
    }
    for (const Contact& c : contacts_) {
        const double along = c.q.dot(c.normal);
        if (!(along > 0)) continue;
        const Vector3d across = c.q - along * c.normal;
        const double size = across.norm();
        const Matrix3d n = c.normal * c.normal.transpose();
        Matrix3d d = c.rho * n;
        if (!c.slides)
            d = c.rho * Matrix3d::Identity();
        else if (size > 0)
            // along its way what slides is not held, across it as a force that turns with it
            d += c.rho * c.held *
                 (Matrix3d::Identity() - n - across * across.transpose() / (size * size));
        const Matrix3d turn = c.body == kNoIndex ? Matrix3d::Zero().eval() : skew(c.arm);
        const Matrix3d d_turn = d * turn;
        for (std::uint32_t k = 0; k < c.points; ++k) {
            if (mass[c.particle[k]] == 0) continue;
            system.add(c.particle[k], c.weight[k] * c.weight[k] * d);
            for (std::uint32_t l = k + 1; l < c.points; ++l)
                if (mass[c.particle[l]] > 0)
                    add_between(c.particle[k], c.particle[l], c.weight[k] * c.weight[l] * d,
                                system);
            if (c.body == kNoIndex) continue;
            system.add_pair(first_pair + c.pair[k], -c.weight[k] * d);
            system.add_pair(first_pair + c.pair[k] + 1, c.weight[k] * d_turn);
        }
        if (c.body == kNoIndex) continue;
        const std::uint32_t row = bodies_[c.body].row;
        system.add(row, d);
        system.add_more(row, row + 1, -d_turn);
        system.add(row + 1, turn.transpose() * d_turn);
    }
}

double ElasticContacts::take_forces() {
    double most = 0;
    for (Contact& c : contacts_) {
        if (c.rho > 0) most = std::max(most, (c.p - c.q).norm() / c.rho);
        c.p = c.q;
    }
    return most;
}

/// By the least changes, in the mean of the squares. A single point can give a body no torque, so
/// some of its velocity may remain without an impulse.
void ElasticContacts::match(const std::vector<Vector3d>& v, const std::vector<Vector3d>& target) {
    for (Body& body : bodies_) {
        const Vector3d push = body.mass * (v[body.row] - target[body.row]),
                       turn = body.inertia * (v[body.row + 1] - target[body.row + 1]);
        body.missing << -push, -turn;
        body.reach.setZero();
    }
    const auto is_felt = [](const Contact& c) { return c.body != kNoIndex && !c.q.isZero(0); };
    for (const Contact& c : contacts_) {
        if (!is_felt(c)) continue;
        Body& body = bodies_[c.body];
        body.missing.head<3>() -= c.q, body.missing.tail<3>() -= c.arm.cross(c.q);
        const Matrix3d turn = skew(c.arm);
        body.reach.topLeftCorner<3, 3>() += Matrix3d::Identity();
        body.reach.bottomLeftCorner<3, 3>() += turn;
        body.reach.topRightCorner<3, 3>() += turn.transpose();
        body.reach.bottomRightCorner<3, 3>() += turn * turn.transpose();
    }
    for (Body& body : bodies_) {
        // lengths against the body's own, so that forces and torques are of one kind
        const double size = std::sqrt(body.inertia.trace() / body.mass);
        Vector6d scale;
        scale << 1, 1, 1, 1 / size, 1 / size, 1 / size;
        const Matrix6d reach = scale.asDiagonal() * body.reach * scale.asDiagonal();
        const Eigen::SelfAdjointEigenSolver<Matrix6d> principal(reach);
        const Vector6d wish =
            principal.eigenvectors().transpose() * (scale.asDiagonal() * body.missing);
        const double least = kWithinReach * principal.eigenvalues()[5];
        Vector6d found = Vector6d::Zero();
        for (int k = 0; k < 6; ++k)
            if (principal.eigenvalues()[k] > least)
                found += wish[k] / principal.eigenvalues()[k] * principal.eigenvectors().col(k);
        body.missing = scale.asDiagonal() * found;
    }
    for (Contact& c : contacts_)
        if (is_felt(c)) {
            const Vector6d& more = bodies_[c.body].missing;
            c.q += more.head<3>() + more.tail<3>().cross(c.arm);
        }
}

void ElasticContacts::store(std::vector<ElasticImpulse>& impulses) const {
    impulses.clear();
    impulses.reserve(contacts_.capacity());
    for (const ElasticImpulse& key : keys_) {
        impulses.push_back(key);
        impulses.back().impulse = contacts_[key.order].p;
    }
}

}  // namespace plumb
