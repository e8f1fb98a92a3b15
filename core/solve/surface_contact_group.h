// SPDX-License-Identifier: MIT
/// Contacts of points with surfaces that deform, one after another: a point of a particle or a body
/// against three particles, whose connectors are the weights of the triangle's nearest point (§7).
#pragma once

#include "constraints/connector.h"
#include "constraints/contact.h"
#include "effects/plan.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/particle_rows.h"
#include "solve/triangle_couple.h"

#include <array>
#include <vector>

namespace plumb {

template <class Real>
class SurfaceContactGroup final : public ConstraintGroup<Real> {
public:
    SurfaceContactGroup(const Plan& plan, Workers& workers)
        : has_friction_(plan.runs(Effect::friction)), workers_(workers) {}

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
            row.couple = TriangleCouple(p, c);
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
    struct Row {
        std::int32_t point = 0, corner[3] = {0, 0, 0};
        InverseMass<double> inverse{0, {0, 0, 0, 0, 0, 0}};
        Vector3d arm = Vector3d::Zero(), normal = Vector3d::Zero();
        double weight[3] = {0, 0, 0}, corner_mass[3] = {0, 0, 0};
        TriangleCouple couple;
        double gap = 0, mass = 0, friction = 0;
        double push = 0;                               ///< summed along the normal [N s]
        bool is_idle = true;                           ///< it has never pushed
        Vector3d friction_impulse = Vector3d::Zero();  ///< summed across it [N s]
    };

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
        const std::array<Vector3d, 3> turned = row.couple.changes_by(impulse);
        for (int k = 0; k < 3; ++k)
            add_change(rows, row.corner[k],
                       Velocity<double>{
                           Vector3d(impulse * (-row.weight[k] * row.corner_mass[k]) + turned[k]),
                           Vector3d::Zero()});
    }

    bool has_friction_;
    Workers& workers_;
    std::vector<Row> rows_;
};

}  // namespace plumb
