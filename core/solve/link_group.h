// SPDX-License-Identifier: MIT
/// Links between points of bodies, particles and the world, one after another.
#pragma once

#include "constraints/link.h"
#include "constraints/points.h"
#include "math/rotation.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/joined_bodies.h"
#include "solve/particle_rows.h"
#include "ties/linked_point.h"

#include <cmath>
#include <vector>

namespace plumb {

template <class Real>
class LinkGroup final : public ConstraintGroup<Real> {
public:
    /// `in_island` [link]: 1 where an exact island solves it in this step; `bodies`: null, or what
    /// also passes impulses on between particles and bodies that are joined.
    LinkGroup(const World& world, const std::vector<std::uint8_t>& in_island,
              const JoinedBodies<Real>* bodies, Workers& workers)
        : in_island_(in_island), bodies_(bodies), workers_(workers) {
        all_.reserve(world.links.size()), rows_.reserve(world.links.size());
        for (std::uint32_t i = 0; i < world.links.size(); ++i) {
            const Link& link = world.links[i];
            Row row;
            row.index = i, row.link = link;
            row.row_a = row_of(world, link.a), row.row_b = row_of(world, link.b);
            all_.push_back(row);
        }
    }

    Stage stage() const override { return Stage::links; }
    bool empty() const override { return rows_.empty(); }

    void load(const World&) override {
        rows_.clear();
        for (const Row& row : all_)
            if (!in_island_[row.index]) rows_.push_back(row);
    }

    void begin(const World& world, const BodyRows<Real>&, const PassSettings<Real>&,
               double h) override {
        h_ = h;
        for (Row& row : rows_) {
            row.a = linked_point(world, row.link.a), row.b = linked_point(world, row.link.b);
            const Vector3d apart = row.a.start - row.b.start;
            row.length = apart.norm();
            row.line = line_of(apart);
            row.share = line_share(link_load(world.links[row.index], row.a, row.b, h));
            row.impulse.setZero();
        }
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>&,
                           std::uint32_t worker) override {
        if (worker == 0)
            for (Row& row : rows_) row.link.joins ? join(rows, row) : keep_length(rows, row);
        workers_.barrier();
    }

    void end_substep(World& world) override {
        for (const Row& row : rows_) {
            Vector3d& impulse = world.links[row.index].impulse = row.impulse;
            if (bodies_) impulse += bodies_->impulse(row.index);
        }
    }

private:
    struct Row {
        std::uint32_t index = 0;  ///< in the world's table
        Link link;
        std::int32_t row_a = 0, row_b = 0;
        LinkedPoint a, b;
        Vector3d line = Vector3d::Zero();
        double length = 0, share = 0;  ///< at the start [m]; of the line's turn that is followed
        Vector3d impulse = Vector3d::Zero();  ///< on a
    };

    static std::int32_t row_of(const World& world, const WorldPoint& p) {
        if (p.particle != kNoIndex) return world.particle_row(p.particle);
        return p.body == kNoIndex ? world.zero_row() : world.bodies.row[p.body];
    }

    /// Where a point is at the end of the substep as things stand, against its start [m].
    Vector3d moved(const BodyRows<Real>& rows, std::int32_t row, const LinkedPoint& p) const {
        const Velocity<double> velocity = velocity_of(rows, row);
        return h_ * velocity.v + Turn<double>(Vector3d(h_ * velocity.w)).change(p.arm);
    }

    void push(const BodyRows<Real>& rows, Row& row, const Vector3d& impulse) const {
        row.impulse += impulse;
        push(rows, row.row_a, row.a, impulse);
        push(rows, row.row_b, row.b, -impulse);
    }
    static void push(const BodyRows<Real>& rows, std::int32_t row, const LinkedPoint& p,
                     const Vector3d& impulse) {
        Velocity<double> change{Vector3d::Zero(), Vector3d::Zero()};
        apply_impulse<double>(change, p.inverse, p.arm, impulse);
        add_change(rows, row, change);
    }

    void keep_length(const BodyRows<Real>& rows, Row& row) const {
        const Vector3d apart = row.a.start - row.b.start + moved(rows, row.row_a, row.a) -
                               moved(rows, row.row_b, row.b);
        const double length = apart.norm();
        if (!(length > 0)) return;
        const Vector3d end = apart / length;
        Vector3d line = (1 - row.share) * row.line + row.share * end;
        // what turns by more than a third of a turn has left its line behind
        line = line.dot(end) > 0.5 ? line.normalized() : end;
        const double slope = line.dot(end) * line_response(row.a, row.b, line);
        if (!(slope > 0)) return;
        const double time = row.link.compliance * row.link.damping;
        const double soft = point_softness(row.link.compliance, time, h_);
        const double lag = point_lag(time, h_);
        const double sum = row.impulse.dot(line);  // pulls a towards b where negative
        const auto summed = [&](double rest) {
            const double c = (length - rest) - lag * (row.length - rest);
            return sum - (c / h_ + soft * sum) / (slope + soft);
        };
        double after = summed(row.link.longest);
        if (row.link.shortest < row.link.longest)
            after = std::min(0.0, after) + std::max(0.0, summed(row.link.shortest));
        push(rows, row, (after - sum) * line);
    }

    void join(const BodyRows<Real>& rows, Row& row) const {
        const Vector3d apart = row.a.start - row.b.start + moved(rows, row.row_a, row.a) -
                               moved(rows, row.row_b, row.b);
        const double soft = row.link.compliance / (h_ * h_);
        // at one common point, that of a: opposite impulses keep angular momentum
        LinkedPoint b = row.b;
        b.arm += row.a.start - row.b.start;
        Symmetric3<double> k =
            point_response(row.a.inverse, row.a.arm) + point_response(b.inverse, b.arm);
        k.xx += soft, k.yy += soft, k.zz += soft;
        if (!(k.xx > 0)) return;
        const Vector3d wish = -(apart / h_ + soft * row.impulse);
        const Vector3d impulse = solve_ldlt<double>(k, wish);
        row.impulse += impulse;
        push(rows, row.row_a, row.a, impulse);
        push(rows, row.row_b, b, -impulse);
    }

    const std::vector<std::uint8_t>& in_island_;
    const JoinedBodies<Real>* bodies_;
    Workers& workers_;
    std::vector<Row> all_, rows_;  // rows_: of those that no island solves
    double h_ = 0;
};

}  // namespace plumb
