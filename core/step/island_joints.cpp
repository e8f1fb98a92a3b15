// SPDX-License-Identifier: MIT
#include "step/island_joints.h"

#include "step/drive_state.h"
#include "step/driven_axes.h"
#include "step/joint_geometry.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Of a body of the world, which is immovable.
Velocity<double> held_velocity(const Bodies& b, std::uint32_t body) {
    if (body == kNoIndex) return {Vector3d::Zero(), Vector3d::Zero()};
    return {b.velocity[body], b.angular_velocity[body]};
}

/// A row along axes of the world, where it does not matter along which: so a plain ball keeps its
/// impulses (world/joints.h).
JointGeometry<double> geometry_of(const World& world, const Joint& joint, const SubstepTime& time) {
    JointGeometry<double> g = joint_geometry(world, joint, time);
    if (joint.is_plain_ball())
        for (int k = 0; k < 3; ++k) g.e[k] = Vector3d::Unit(k);
    return g;
}

}  // namespace

void IslandJoints::clear() { joints_.clear(), axes_.clear(), rows_.clear(); }

void IslandJoints::add(const World& world, std::uint32_t joint, std::uint32_t a, std::uint32_t b) {
    Member& m = joints_.emplace_back();
    m.joint = joint, m.a = a, m.b = b;
    m.first_axis = static_cast<std::uint32_t>(axes_.size());
    each_driven_axis(world.joints, joint, [&](std::uint32_t first, std::uint32_t last) {
        axes_.push_back({first, last, {}});
    });
    m.last_axis = static_cast<std::uint32_t>(axes_.size());
}

void IslandJoints::begin(const World& world, const SubstepTime& time) {
    h_ = time.h;
    rows_.clear();
    for (Member& member : joints_) begin(world, time, member);
}

void IslandJoints::begin(const World& world, const SubstepTime& time, Member& m) {
    const Joint& joint = world.joints.joints[m.joint];
    if (m.a == kImmovable) m.held_a = held_velocity(world.bodies, joint.a);
    if (m.b == kImmovable) m.held_b = held_velocity(world.bodies, joint.b);
    m.geometry = geometry_of(world, joint, time);
    defer_errors(m.deferred, m.geometry, h_ * world.settings.recovery_speed);
    const Velocity<double> rest{Vector3d::Zero(), Vector3d::Zero()};
    const JointRows<double> now = joint_rows<double>(m.geometry, rest, rest, h_);
    m.first_row = static_cast<std::uint32_t>(rows_.size());
    for (int k = 0; k < 6; ++k) {
        if (!(m.geometry.lock[k] > 0)) continue;
        const Vector3d along = k < 3 ? now.e[k] : Vector3d(Vector3d::Zero());
        add_row(world, m, along, now.g_a[k], now.g_b[k]);
        rows_.back().softness = m.geometry.softness[k];
        rows_.back().impulse = joint.rows[k];
    }
    m.first_axis_row = static_cast<std::uint32_t>(rows_.size());
    for (std::uint32_t i = m.first_axis; i < m.last_axis; ++i) add_axis_row(world, time, m, i);
    m.last_row = static_cast<std::uint32_t>(rows_.size());
}

void IslandJoints::add_axis_row(const World& world, const SubstepTime& time, const Member& m,
                                std::uint32_t at) {
    Axis& axis = axes_[at];
    const JointDrive& leader = world.joints.drives[axis.first];
    const Joint& joint = world.joints.joints[m.joint];
    const JointCoordinate q = joint_coordinate(world, m.joint, leader.axis);
    const double mass = driven_mass(world, joint, m.geometry, q);
    axis.drive = {};
    for (std::uint32_t i = axis.first; i < axis.last; ++i)
        axis.drive.add(drive_row(world, world.joints.drives[i], q, mass, time));
    add_row(world, m, q.along, q.turn_a, q.turn_b);
    IslandRow& row = rows_.back();
    row.drive = &axis.drive;
    for (std::uint32_t i = axis.first; i < axis.last; ++i)
        row.impulse += world.joints.drives[i].impulse;
    const auto part = [&](std::uint32_t body, const Velocity<double>& held, const Vector3d& turn) {
        return body == kImmovable ? q.along.dot(held.v) + turn.dot(held.w) : 0;
    };
    row.moving = part(m.a, m.held_a, q.turn_a) - part(m.b, m.held_b, q.turn_b);
}

void IslandJoints::add_row(const World& world, const Member& m, const Vector3d& along,
                           const Vector3d& turn_a, const Vector3d& turn_b) {
    const Joint& joint = world.joints.joints[m.joint];
    const InverseMass<double> of_a = inverse_mass(world.bodies, joint.a),
                              of_b = inverse_mass(world.bodies, joint.b);
    const double mass = of_a.mass + of_b.mass;
    IslandRow& row = rows_.emplace_back();
    row.a = m.a, row.b = m.b;
    row.on_a << along, turn_a;
    row.on_b << -along, -turn_b;
    row.mass = 1 / (mass * along.squaredNorm() + turn_a.dot(Vector3d(of_a.inertia * turn_a)) +
                    turn_b.dot(Vector3d(of_b.inertia * turn_b)));
    row.length = along.isZero(0) ? std::sqrt(row.mass * mass) : 1;
}

std::span<IslandRow> IslandJoints::rows(std::uint32_t first, std::uint32_t last) {
    if (first == last) return {};
    return std::span(rows_).subspan(joints_[first].first_row,
                                    joints_[last - 1].last_row - joints_[first].first_row);
}

double IslandJoints::ask(std::uint32_t first, std::uint32_t last,
                         std::span<const Vector6d> velocity) {
    double worst = 0;
    for (std::uint32_t i = first; i < last; ++i) worst = std::max(worst, ask(joints_[i], velocity));
    return worst;
}

double IslandJoints::ask(Member& m, std::span<const Vector6d> velocity) {
    const auto of = [&](std::uint32_t body, const Velocity<double>& held) -> Velocity<double> {
        if (body == kImmovable) return held;
        return {velocity[body].head<3>(), velocity[body].tail<3>()};
    };
    const JointPreview<double> preview(m.geometry, of(m.a, m.held_a), of(m.b, m.held_b), h_);
    double c[6], worst = 0;
    joint_errors<double>(c, m.geometry, preview);
    for (std::uint32_t k = 0, at = m.first_row; at < m.first_axis_row; ++k) {
        if (!(m.geometry.lock[k] > 0)) continue;
        IslandRow& row = rows_[at++];
        const double open = c[k] - m.deferred[k];
        row.wanted = rate_of(row, velocity) - open / h_;
        worst = std::max(worst, std::abs(open + h_ * row.softness * row.impulse));
    }
    return worst;
}

void IslandJoints::store_impulses(std::uint32_t first, std::uint32_t last,
                                  std::span<const Vector6d> velocity, JointTable& table) const {
    for (std::uint32_t i = first; i < last; ++i) {
        const Member& m = joints_[i];
        Joint& joint = table.joints[m.joint];
        joint.rows_before = joint.rows;
        std::uint32_t at = m.first_row;
        for (std::uint32_t k = 0; k < kJointAxes; ++k)
            joint.rows[k] = m.geometry.lock[k] > 0 ? rows_[at++].impulse : 0;
        for (std::uint32_t axis = m.first_axis; axis < m.last_axis; ++axis, ++at) {
            const IslandRow& row = rows_[at];
            AxisAnswer met = answer_of(*row.drive, rate_of(row, velocity) + row.moving, row.impulse,
                                       1 / row.mass);
            met.impulse = row.impulse;
            double shares[AxisDrive::kMostRows] = {};
            share_impulse(*row.drive, met, shares);
            for (std::uint32_t d = axes_[axis].first; d < axes_[axis].last; ++d) {
                JointDrive& drive = table.drives[d];
                drive.impulse_before = drive.impulse;
                drive.impulse = shares[d - axes_[axis].first], drive.axis_impulse = row.impulse;
            }
        }
    }
}

}  // namespace plumb
