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
        pushes_.reserve(world.surface_contacts.capacity());
        rows_.resize(world.surface_contacts.size());
    }

    void begin(const World& world, const BodyRows<Real>&, const PassSettings<Real>&,
               double) override {
        world_ = &world;
        pushes_.clear();
        const Particles& p = world.particles;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const SurfaceContact& c = world.surface_contacts[i];
            Row& row = rows_[i];
            row = Row();
            row.normal = c.normal;
            const InverseMass<double> inverse = inverse_of(c.point);
            row.of_body = c.point.particle == kNoIndex;
            Vector3d place;
            if (row.of_body) {
                place = in_world(world.bodies, c.point.body, c.point.position);
                row.point = world.bodies.row[c.point.body];
                // at the triangle's point, which is where both touch
                for (int k = 0; k < 3; ++k) row.arm += c.weights[k] * p.position[c.triangle[k]];
                row.arm -= world.bodies.position[c.point.body];
            } else {
                place = p.position[c.point.particle];
                row.point = world.particle_row(c.point.particle);
            }
            double response = plumb::response(inverse, row.arm, c.normal, c.normal);
            for (int k = 0; k < 3; ++k) {
                row.corner[k] = world.particle_row(c.triangle[k]);
                row.weight[k] = c.weights[k];
                place -= c.weights[k] * p.position[c.triangle[k]];
                response += c.weights[k] * c.weights[k] * p.inverse_mass[c.triangle[k]];
            }
            row.gap = c.normal.dot(place) - c.distance;
            row.mass = response > 0 ? 1 / response : 0;
        }
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        if (worker == 0)
            for (std::size_t i = 0; i < rows_.size(); ++i)
                solve(rows, pass,
                      (pass.iteration + pass.round) % 2 == 0 ? i : rows_.size() - 1 - i);
        workers_.barrier();
    }

private:
    /// What tells whether a contact pushes: most that may touch do not.
    struct Row {
        std::int32_t point = 0, corner[3] = {0, 0, 0};
        std::uint32_t push = kNoIndex;  ///< in pushes_, once it has pushed
        bool of_body = false;
        double weight[3] = {0, 0, 0};
        Vector3d arm = Vector3d::Zero(), normal = Vector3d::Zero();
        double gap = 0, mass = 0;
    };
    struct Push {
        InverseMass<double> inverse;
        double corner_mass[3];  ///< inverse masses [1/kg]
        TriangleCouple couple;
        double friction;
        double sum = 0;                                ///< along the normal [N s]
        Vector3d friction_impulse = Vector3d::Zero();  ///< summed across it [N s]
    };

    void solve(const BodyRows<Real>& rows, const PassSettings<Real>& pass, std::size_t i) {
        Row& row = rows_[i];
        if (row.mass == 0) return;
        const double h = double(pass.h), s = double(pass.stiffness);
        const Velocity<double> point = velocity_of(rows, row.point);
        Vector3d u = row.of_body ? velocity_at(point, row.arm) : point.v;
        for (int k = 0; k < 3; ++k) u -= row.weight[k] * velocity_of(rows, row.corner[k]).v;
        const double left = overlap_left(row.gap, double(pass.recovery));
        const double c = row.gap + h * row.normal.dot(u) - left, d = std::min(row.gap, 0.0) - left;
        const double below = gap_below(c, d, s);
        if (row.push == kNoIndex) {
            if (below >= 0) return;
            row.push = add_push(world_->surface_contacts[i]);
        }
        Push& push = pushes_[row.push];
        const double pushed = plumb::push(push.sum, -below * row.mass / h, 0.0);
        Vector3d impulse = pushed * row.normal;
        if (push.friction > 0) {
            const Vector3d across = u - row.normal.dot(u) * row.normal;
            const Vector3d before = push.friction_impulse;
            push.friction_impulse -= row.mass * across;
            const double size = push.friction_impulse.norm(), most = push.friction * push.sum;
            if (size > most) push.friction_impulse *= most / size;
            impulse += push.friction_impulse - before;
        }
        Velocity<double> change{Vector3d::Zero(), Vector3d::Zero()};
        apply_impulse<double>(change, push.inverse, row.arm, impulse);
        add_change(rows, row.point, change);
        const std::array<Vector3d, 3> turned = push.couple.changes_by(impulse);
        for (int k = 0; k < 3; ++k)
            add_change(rows, row.corner[k],
                       Velocity<double>{
                           Vector3d(impulse * (-row.weight[k] * push.corner_mass[k]) + turned[k]),
                           Vector3d::Zero()});
    }

    /// Returns its place.
    std::uint32_t add_push(const SurfaceContact& c) {
        const Particles& p = world_->particles;
        Push push{inverse_of(c.point), {}, {}, has_friction_ ? c.friction : 0};
        for (int k = 0; k < 3; ++k) push.corner_mass[k] = p.inverse_mass[c.triangle[k]];
        if (c.point.particle != kNoIndex) push.couple = TriangleCouple(p, c);
        pushes_.push_back(push);
        return static_cast<std::uint32_t>(pushes_.size()) - 1;
    }

    InverseMass<double> inverse_of(const WorldPoint& point) const {
        if (point.particle != kNoIndex)
            return {world_->particles.inverse_mass[point.particle], {0, 0, 0, 0, 0, 0}};
        return {world_->bodies.inverse_mass[point.body],
                world_->bodies.world_inverse_inertia[point.body]};
    }

    bool has_friction_;
    Workers& workers_;
    const World* world_ = nullptr;  ///< of this substep
    std::vector<Row> rows_;         ///< [contact]
    std::vector<Push> pushes_;
};

}  // namespace plumb
