// SPDX-License-Identifier: MIT
#include "ties/tied_joints.h"

#include "constraints/tree_stiffness.h"
#include "ties/drive_state.h"
#include "ties/driven_axes.h"
#include "ties/joint_geometry.h"
#include "ties/lever_of.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// A row along axes of the world, where it does not matter along which: so a plain ball keeps its
/// impulses (world/joints.h).
JointGeometry<double> geometry_of(const World& world, const Joint& joint, const SubstepTime& time) {
    JointGeometry<double> g = joint_geometry(world, joint, time);
    if (joint.is_plain_ball())
        for (int k = 0; k < 3; ++k) g.e[k] = Vector3d::Unit(k);
    return g;
}

TieRow row_of(const World& world, const Joint& joint, std::uint32_t a, std::uint32_t b,
              const Vector3d& along, const Vector3d& turn_a, const Vector3d& turn_b) {
    const InverseMass<double> of_a = inverse_mass(world.bodies, joint.a),
                              of_b = inverse_mass(world.bodies, joint.b);
    const double mass = of_a.mass + of_b.mass;
    TieRow row;
    Vector6d on;
    on << along, turn_a;
    row.add_side(a, on);
    on << -along, -turn_b;
    row.add_side(b, on);
    row.mass = 1 / (mass * along.squaredNorm() + turn_a.dot(Vector3d(of_a.inertia * turn_a)) +
                    turn_b.dot(Vector3d(of_b.inertia * turn_b)));
    row.length = along.isZero(0) ? std::sqrt(row.mass * mass) : 1;
    return row;
}

}  // namespace

void TiedJoints::clear() { joints_.clear(), axes_.clear(); }

void TiedJoints::add(const World& world, std::uint32_t joint, const TiedBodies& at) {
    Member& m = joints_.emplace_back();
    m.joint = joint;
    m.a = at[0], m.b = at[1];
    m.first_axis = static_cast<std::uint32_t>(axes_.size());
    each_driven_axis(world.joints, joint, [&](std::uint32_t first, std::uint32_t last) {
        axes_.push_back({first, last, {}});
    });
    m.last_axis = static_cast<std::uint32_t>(axes_.size());
}

void TiedJoints::begin(const World& world, const SubstepTime& time, std::uint32_t i,
                       std::vector<TieRow>& rows) {
    Member& m = joints_[i];
    const Joint& joint = world.joints.joints[m.joint];
    m.scripted_a = scripted_velocity(world.bodies, joint.a);
    m.scripted_b = scripted_velocity(world.bodies, joint.b);
    m.geometry = geometry_of(world, joint, time);
    defer_errors(m.deferred, m.old, m.geometry, time.h * world.settings.recovery_speed);
    const Velocity<double> rest{Vector3d::Zero(), Vector3d::Zero()};
    const JointRows<double> now = joint_rows<double>(m.geometry, rest, rest, time.h);
    m.load.setZero();
    m.first_row = static_cast<std::uint32_t>(rows.size());
    for (int k = 0; k < 6; ++k) {
        if (!(m.geometry.lock[k] > 0)) continue;
        if (k < 3) m.load += joint.rows[k] * now.e[k];
        const Vector3d along = k < 3 ? now.e[k] : Vector3d(Vector3d::Zero());
        TieRow& row =
            rows.emplace_back(row_of(world, joint, m.a, m.b, along, now.g_a[k], now.g_b[k]));
        row.softness = m.geometry.softness[k];
        row.impulse = joint.rows[k];
    }
    m.first_axis_row = static_cast<std::uint32_t>(rows.size());
    for (std::uint32_t axis = m.first_axis; axis < m.last_axis; ++axis)
        rows.push_back(axis_row(world, time, m, axes_[axis]));
}

TieRow TiedJoints::axis_row(const World& world, const SubstepTime& time, const Member& m,
                            Axis& axis) const {
    const JointDrive& leader = world.joints.drives[axis.first];
    const Joint& joint = world.joints.joints[m.joint];
    const JointCoordinate q = joint_coordinate(world, m.joint, leader.axis);
    const double mass = driven_mass(world, joint, m.geometry, q);
    axis.drive = {};
    for (std::uint32_t i = axis.first; i < axis.last; ++i)
        axis.drive.add(drive_row(world, world.joints.drives[i], q, mass, time));
    TieRow row = row_of(world, joint, m.a, m.b, q.along, q.turn_a, q.turn_b);
    row.drive = &axis.drive;
    for (std::uint32_t i = axis.first; i < axis.last; ++i)
        row.impulse += world.joints.drives[i].impulse;
    const auto part = [&](std::uint32_t body, const Velocity<double>& v, const Vector3d& turn) {
        return body == kImmovable ? q.along.dot(v.v) + turn.dot(v.w) : 0;
    };
    row.moving = part(m.a, m.scripted_a, q.turn_a) - part(m.b, m.scripted_b, q.turn_b);
    return row;
}

void TiedJoints::stiffen(const World& world, double h, std::uint32_t i,
                         std::span<SolvedBody> bodies) const {
    constexpr double kTheta = 0.5;
    const Member& m = joints_[i];
    const Joint& joint = world.joints.joints[m.joint];
    const auto stiffen = [&](std::uint32_t at, std::uint32_t body, const Vector3d& arm,
                             const Vector3d& load) {
        if (at == kImmovable) return;
        const double share = kTheta * between_0_and_1(tree_load(world, joint, body, arm, h) - 1);
        if (!(share > 0)) return;
        Symmetric3<double>& inertia = bodies[at].inertia;
        inertia = inertia + non_negative_part(angular_stiffness<double>(arm, load, share * h));
        bodies[at].inverse_inertia = inverse(inertia);
    };
    stiffen(m.a, joint.a, m.geometry.r_a, m.load);
    stiffen(m.b, joint.b, m.geometry.r_b, -m.load);
}

double TiedJoints::open_at_start(std::uint32_t i) const {
    double worst = 0;
    for (const double error : joints_[i].old) worst = std::max(worst, std::abs(error));
    return worst;
}

double TiedJoints::ask(std::uint32_t i, std::span<const Vector6d> velocity, double h, OldErrors old,
                       std::vector<TieRow>& rows) const {
    const Member& m = joints_[i];
    const bool keeps = old == OldErrors::kept;
    const Velocity<double> rest{Vector3d::Zero(), Vector3d::Zero()};
    const JointPreview<double> preview(m.geometry,
                                       velocity_of(m.a, keeps ? rest : m.scripted_a, velocity),
                                       velocity_of(m.b, keeps ? rest : m.scripted_b, velocity), h);
    double c[6], worst = 0;
    joint_errors<double>(c, m.geometry, preview);
    for (std::uint32_t k = 0, at = m.first_row; at < m.first_axis_row; ++k) {
        if (!(m.geometry.lock[k] > 0)) continue;
        TieRow& row = rows[at++];
        const double open = c[k] - (keeps ? m.old : m.deferred)[k];
        row.wanted = rate_of(row, velocity) - open / h;
        worst = std::max(worst, std::abs(open + h * row.softness * row.impulse));
    }
    return worst;
}

double TiedJoints::open_at_end(std::uint32_t i, std::span<const Vector6d> velocity,
                               double h) const {
    const Member& m = joints_[i];
    double c[6], worst = 0;
    joint_errors<double>(c, m.geometry,
                         JointPreview<double>(m.geometry, velocity_of(m.a, m.scripted_a, velocity),
                                              velocity_of(m.b, m.scripted_b, velocity), h));
    for (int k = 0; k < 6; ++k)
        if (m.geometry.lock[k] > 0 && !(m.geometry.softness[k] > 0))
            worst = std::max(worst, std::abs(c[k]));
    return worst;
}

double TiedJoints::scripted_speed(std::uint32_t i) const {
    const Member& m = joints_[i];
    const auto speed = [](std::uint32_t body, const Velocity<double>& v, const Vector3d& arm) {
        return body == kImmovable ? (v.v + v.w.cross(arm)).norm() : 0;
    };
    return std::max(speed(m.a, m.scripted_a, m.geometry.r_a),
                    speed(m.b, m.scripted_b, m.geometry.r_b));
}

void TiedJoints::store_impulses(std::uint32_t i, std::span<const Vector6d> velocity,
                                const std::vector<TieRow>& rows, JointTable& table) const {
    const Member& m = joints_[i];
    Joint& joint = table.joints[m.joint];
    joint.rows_before = joint.rows;
    std::uint32_t at = m.first_row;
    for (std::uint32_t k = 0; k < kJointAxes; ++k)
        joint.rows[k] = m.geometry.lock[k] > 0 ? rows[at++].impulse : 0;
    for (std::uint32_t axis = m.first_axis; axis < m.last_axis; ++axis, ++at) {
        const TieRow& row = rows[at];
        AxisAnswer met =
            answer_of(*row.drive, rate_of(row, velocity) + row.moving, row.impulse, 1 / row.mass);
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

}  // namespace plumb
