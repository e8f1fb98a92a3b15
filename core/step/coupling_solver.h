// SPDX-License-Identifier: MIT
/// Couplings (gears, racks, mimics): C = q_b − ratio q_a − offset = 0. A row has up to four bodies,
/// so they are solved one after another.
///
/// What the motion has added to C goes in one substep, so that a gear holds. More than a few
/// substeps can have added, such as an offset far from where the joints stand, is deferred and goes
/// at Settings::recovery_speed.
#pragma once

#include "schedule/contact_rows.h"
#include "step/joint_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plumb {

template <class Real>
class CouplingSolver {
public:
    bool empty() const { return rows_.empty(); }

    void begin(const World& world, double h) {
        const bool first = rows_.empty();
        rows_.resize(world.joints.couplings.size());
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const JointCoupling& coupling = world.joints.couplings[i];
            Row row;
            const JointCoordinate a = joint_coordinate(world, coupling.joint_a, coupling.axis_a),
                                  b = joint_coordinate(world, coupling.joint_b, coupling.axis_b);
            add_sides(row, world, world.joints.joints[coupling.joint_a], a, -coupling.ratio);
            add_sides(row, world, world.joints.joints[coupling.joint_b], b, 1);
            double k = 0;
            for (const Side& side : row.sides)
                k += side.along.dot(side.to_v) + side.turn.dot(side.to_w);
            const bool whole = !world.joints.joints[coupling.joint_a].broken &&
                               !world.joints.joints[coupling.joint_b].broken;
            row.mass = whole && k > 0 ? 1 / k : 0;
            row.deferred = first ? coupling.deferred : rows_[i].deferred;
            set_bias(row, world, coupling, a, b, h);
            rows_[i] = row;
        }
    }

    void solve(const BodyRows<Real>& bodies) {
        for (Row& row : rows_) {
            double rate = 0;
            for (const Side& side : row.sides) rate += rate_of(side, bodies);
            const double impulse = -row.mass * (rate + row.bias);
            row.lambda += impulse;
            push(row, bodies, impulse);
        }
    }

    void store_impulses(JointTable& table) const {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            table.couplings[i].impulse = rows_[i].lambda;
            table.couplings[i].deferred = rows_[i].deferred;
        }
    }

private:
    /// What one body adds to the row, and what an impulse of the row does to it.
    struct Side {
        std::int32_t body = -1;
        Vector3d along = Vector3d::Zero(), turn = Vector3d::Zero();
        Vector3d to_v = Vector3d::Zero(), to_w = Vector3d::Zero();
    };
    struct Row {
        std::array<Side, 4> sides;
        double mass = 0, bias = 0, lambda = 0;
        double deferred = 0;  ///< of C [m], [rad]
    };

    /// What iterations leave adds up over so many substeps at most.
    static constexpr double kMadeAtOnce = 4;

    /// What is left of an error when so much of it is taken away.
    static double without(double error, double taken) {
        return error - std::clamp(error, -taken, taken);
    }

    /// A body that stands on both sides, as the frame that carries two wheels does, has one entry.
    static void add_side(Row& row, const World& world, std::uint32_t body, const Vector3d& along,
                         const Vector3d& turn) {
        if (body == kNoIndex || world.bodies.motion[body] == Motion::fixed) return;
        const std::int32_t at = world.bodies.row[body];
        for (Side& side : row.sides) {
            if (side.body != -1 && side.body != at) continue;
            side.body = at;
            side.along += along, side.turn += turn;
            side.to_v = world.bodies.inverse_mass[body] * side.along;
            side.to_w = world.bodies.world_inverse_inertia[body] * side.turn;
            return;
        }
    }
    static void add_sides(Row& row, const World& world, const Joint& joint,
                          const JointCoordinate& q, double factor) {
        add_side(row, world, joint.a, factor * q.along, factor * q.turn_a);
        add_side(row, world, joint.b, -factor * q.along, -factor * q.turn_b);
    }

    static void set_bias(Row& row, const World& world, const JointCoupling& coupling,
                         const JointCoordinate& a, const JointCoordinate& b, double h) {
        const std::vector<Joint>& joints = world.joints.joints;
        const double speed =
            std::abs(joint_rate(world.bodies, joints[coupling.joint_b], b)) +
            std::abs(coupling.ratio * joint_rate(world.bodies, joints[coupling.joint_a], a));
        const double recovered = h * world.settings.recovery_speed;
        row.deferred = without(row.deferred, recovered);
        const double made = b.value - coupling.ratio * a.value - coupling.offset - row.deferred;
        const double excess = without(made, recovered + kMadeAtOnce * h * speed);
        row.deferred += excess;
        row.bias = (made - excess) / h;
    }

    static double rate_of(const Side& side, const BodyRows<Real>& bodies) {
        if (side.body < 0) return 0;
        const Real* start = bodies.start + side.body * kBodyRowSize;
        const Real* change = bodies.change + side.body * kBodyRowSize;
        double rate = 0;
        for (int k = 0; k < 3; ++k)
            rate += side.along[k] * (double(start[k]) + double(change[k])) +
                    side.turn[k] * (double(start[4 + k]) + double(change[4 + k]));
        return rate;
    }

    static void push(const Row& row, const BodyRows<Real>& bodies, double impulse) {
        for (const Side& side : row.sides) {
            if (side.body < 0 || side.body >= bodies.dynamic_count) continue;
            Real* change = bodies.change + side.body * kBodyRowSize;
            for (int k = 0; k < 3; ++k) {
                change[k] += static_cast<Real>(side.to_v[k] * impulse);
                change[4 + k] += static_cast<Real>(side.to_w[k] * impulse);
            }
        }
    }

    std::vector<Row> rows_;
};

}  // namespace plumb
