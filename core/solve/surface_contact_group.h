// SPDX-License-Identifier: MIT
/// Contacts of points with surfaces that deform, one after another: a point of a particle or a body
/// against three particles, whose connectors are the weights of the triangle's nearest point (§7).
#pragma once

#include "constraints/connector.h"
#include "constraints/contact.h"
#include "effects/plan.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/elastic_contacts.h"
#include "solve/particle_rows.h"

#include <Eigen/LU>

#include <array>
#include <vector>

namespace plumb {

template <class Real>
class SurfaceContactGroup final : public ConstraintGroup<Real> {
public:
    SurfaceContactGroup(const Plan& plan, Workers& workers)
        : has_friction_(plan.runs(Effect::friction)),
          sheets_apart_(has_elastic_contacts(plan)),
          workers_(workers) {}

    Stage stage() const override { return Stage::surface_contacts; }
    bool empty() const override { return rows_.empty(); }

    void load(const World& world) override {
        rows_.reserve(world.surface_contacts.capacity());
        rows_.resize(world.surface_contacts.size());
    }

    void begin(const World& world, const BodyRows<Real>&, const PassSettings<Real>&,
               double) override {
        const Particles& p = world.particles;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const SurfaceContact& c = world.surface_contacts[i];
            Row& row = rows_[i];
            row = Row();
            if (sheets_apart_ && c.point.particle == kNoIndex &&
                has_elastic_contacts(world, c.triangle[0]))
                continue;
            row.normal = c.normal, row.friction = has_friction_ ? c.friction : 0;
            Vector3d place;
            if (c.point.particle != kNoIndex) {
                place = p.position[c.point.particle];
                row.point = world.particle_row(c.point.particle);
                row.inverse.mass = p.inverse_mass[c.point.particle];
            } else {
                place = in_world(world.bodies, c.point.body, c.point.position);
                row.point = world.bodies.row[c.point.body];
                // at the triangle's point, which is where both touch
                for (int k = 0; k < 3; ++k) row.arm += c.weights[k] * p.position[c.triangle[k]];
                row.arm -= world.bodies.position[c.point.body];
                row.inverse = {world.bodies.inverse_mass[c.point.body],
                               world.bodies.world_inverse_inertia[c.point.body]};
            }
            double response = plumb::response(row.inverse, row.arm, c.normal, c.normal);
            for (int k = 0; k < 3; ++k) {
                row.corner[k] = world.particle_row(c.triangle[k]);
                row.weight[k] = c.weights[k];
                row.corner_mass[k] = p.inverse_mass[c.triangle[k]];
                place -= c.weights[k] * p.position[c.triangle[k]];
                response += c.weights[k] * c.weights[k] * row.corner_mass[k];
            }
            row.gap = c.normal.dot(place) - c.distance;
            row.mass = response > 0 ? 1 / response : 0;
            if (c.point.particle == kNoIndex) continue;
            row.offset = place;
            prepare_couple(p, c.triangle, row);
        }
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        if (worker == 0)
            for (std::size_t i = 0; i < rows_.size(); ++i)
                solve(rows, pass,
                      rows_[(pass.iteration + pass.round) % 2 == 0 ? i : rows_.size() - 1 - i]);
        workers_.barrier();
    }

private:
    /// Determinant of a triangle's inertia over that of a ball's of the same trace, from which on
    /// it counts as flat.
    static constexpr double kLeastExtent = 1e-3;

    struct Row {
        std::int32_t point = 0, corner[3] = {0, 0, 0};
        InverseMass<double> inverse{0, {0, 0, 0, 0, 0, 0}};
        Vector3d arm = Vector3d::Zero(), normal = Vector3d::Zero();
        double weight[3] = {0, 0, 0}, corner_mass[3] = {0, 0, 0};
        Vector3d offset = Vector3d::Zero();  ///< of the point from the triangle's [m]
        Vector3d lever[3] = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
        Matrix3d inverse_inertia = Matrix3d::Zero();  ///< of the triangle's particles
        double gap = 0, mass = 0, friction = 0;
        double push = 0;                               ///< summed along the normal [N s]
        bool is_idle = true;                           ///< it has never pushed
        Vector3d friction_impulse = Vector3d::Zero();  ///< summed across it [N s]
    };

    /// Opposite impulses at two points a thickness apart are a couple. The triangle bears it, as a
    /// sheet does with friction on one side, so that angular momentum stays.
    static void prepare_couple(const Particles& p, const std::array<std::uint32_t, 3>& triangle,
                               Row& row) {
        double whole = 0;
        Vector3d centre = Vector3d::Zero();
        for (int k = 0; k < 3; ++k) {
            if (row.corner_mass[k] == 0) return;
            const double m = p.mass[triangle[k]];
            whole += m, centre += m * (p.position[triangle[k]] - p.position[triangle[0]]);
        }
        centre = p.position[triangle[0]] + centre / whole;
        Matrix3d inertia = Matrix3d::Zero();
        for (int k = 0; k < 3; ++k) {
            const Vector3d r = p.position[triangle[k]] - centre;
            row.lever[k] = r;
            inertia +=
                p.mass[triangle[k]] * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
        }
        // a triangle without extent turns about nothing
        const double size = inertia.trace() / 3;
        if (inertia.determinant() > kLeastExtent * size * size * size)
            row.inverse_inertia = inertia.inverse();
    }

    static void solve(const BodyRows<Real>& rows, const PassSettings<Real>& pass, Row& row) {
        if (row.mass == 0) return;
        const double h = double(pass.h), s = double(pass.stiffness);
        Vector3d u = velocity_at(velocity_of(rows, row.point), row.arm);
        for (int k = 0; k < 3; ++k) u -= row.weight[k] * velocity_of(rows, row.corner[k]).v;
        const double left = overlap_left(row.gap, double(pass.recovery));
        const double c = row.gap + h * row.normal.dot(u) - left, d = std::min(row.gap, 0.0) - left;
        const double pushed = plumb::push(row.push, -gap_below(c, d, s) * row.mass / h, 0.0);
        if (pushed == 0 && row.push == 0 && row.is_idle) return;  // most that may touch do not
        row.is_idle = false;
        Vector3d impulse = pushed * row.normal;
        if (row.friction > 0) {
            const Vector3d across = u - row.normal.dot(u) * row.normal;
            const Vector3d before = row.friction_impulse;
            row.friction_impulse -= row.mass * across;
            const double size = row.friction_impulse.norm(), most = row.friction * row.push;
            if (size > most) row.friction_impulse *= most / size;
            impulse += row.friction_impulse - before;
        }
        Velocity<double> change{Vector3d::Zero(), Vector3d::Zero()};
        apply_impulse<double>(change, row.inverse, row.arm, impulse);
        add_change(rows, row.point, change);
        const Vector3d turn = -(row.inverse_inertia * row.offset.cross(impulse));
        for (int k = 0; k < 3; ++k)
            add_change(rows, row.corner[k],
                       Velocity<double>{Vector3d(impulse * (-row.weight[k] * row.corner_mass[k]) +
                                                 turn.cross(row.lever[k])),
                                        Vector3d::Zero()});
    }

    bool has_friction_;
    bool sheets_apart_;  ///< their contacts with bodies are part of the elastic system
    Workers& workers_;
    std::vector<Row> rows_;
};

}  // namespace plumb
