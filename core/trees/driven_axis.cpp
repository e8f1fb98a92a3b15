// SPDX-License-Identifier: MIT
#include "trees/driven_axis.h"

#include "math/rotation.h"
#include "ties/drive_state.h"
#include "ties/joint_state.h"

#include <cmath>
#include <limits>

namespace plumb {
namespace {

/// An impulse beyond its bounds by less than this share of it is within them.
constexpr double kImpulseRounding = 1e-9;

/// What an angle and its rate differ by within a substep, at the most [rad].
constexpr double kFarthestTurn = 1;

/// The most that an angle changes by per angle that a body turns by, where it is looked ahead.
constexpr double kSteepest = 4;

/// No axis is taken to be heavier than its two bodies by more than this.
constexpr double kLeastShare = 1e-6;

void push(BodyBlock<double>& body, const Vector3d& along, const Vector3d& turn, double impulse) {
    body.f += impulse * along;
    body.t += impulse * turn;
}

}  // namespace

DrivenAxis::DrivenAxis(const JointTable& joints, std::uint32_t first, std::uint32_t last)
    : first_(first), last_(last) {
    if (first < last) load_impulse(joints);
}

void DrivenAxis::load_impulse(const JointTable& joints) {
    impulse_ = joints.drives[first_].axis_impulse;
}

void DrivenAxis::begin(const World& world, const SubstepTime& time) {
    const JointDrive& leader = world.joints.drives[first_];
    q_ = joint_coordinate(world, leader.joint, leader.axis);
    const Joint& joint = world.joints.joints[leader.joint];
    const double mass = driven_mass(world, joint, joint_geometry(world, joint, time), q_);
    response_ = bare_ = mass > 0 ? 1 / mass : 0;
    drive_ = {};
    for (std::uint32_t i = first_; i < last_; ++i) {
        rows_[i - first_] = drive_row(world, world.joints.drives[i], q_, mass, time);
        drive_.add(rows_[i - first_]);
    }
    h_ = time.h;
    find_limit(world);
    // what it bore before tells best on which piece it is
    constexpr double any = 1e30;
    answer_ = next_ = response_ > 0 ? answer_of(drive_, 0, impulse_, any) : AxisAnswer{};
    impulse_ = impulse_before_ = 0;
    looks_ = 0, off_ = 0;
}

double DrivenAxis::rate_of(const Velocity<double>& a, const Velocity<double>& b) const {
    return q_.along.dot(a.v - b.v) + q_.turn_a.dot(a.w) - q_.turn_b.dot(b.w);
}

/// Where one turn alone is free, its axis stays. Where angles can hardly be told, as a cone's twist
/// once it has swung right over or any of three angles about axes, their rates change too fast to
/// be followed.
void DrivenAxis::find_limit(const World& world) {
    const JointDrive& leader = world.joints.drives[first_];
    const Joint& joint = world.joints.joints[leader.joint];
    limit_ = -1, joint_ = &joint, axis_ = leader.axis;
    const bool looks_ahead = axis_ < kTurnX || free_turns(joint) == 2 ||
                             (joint.kind == JointKind::cone_twist && q_.turn_a.norm() < kSteepest);
    if (!(response_ > 0) || !looks_ahead) return;
    for (std::uint32_t i = first_; i < last_; ++i)
        if (world.joints.drives[i].kind == DriveKind::limit)
            limit_ = static_cast<int>(i - first_), pose_ = joint_pose(world.bodies, joint);
}

/// By how much the coordinate at the end of the substep differs from what its rate says.
double DrivenAxis::turned(const Velocity<double>& a, const Velocity<double>& b) const {
    JointPose end;
    const auto move = [&](const Velocity<double>& of, const Vector3d& centre, const Vector3d& point,
                          const Matrix3d& axes, Vector3d& new_point, Matrix3d& new_axes) {
        const UnitQuaternion<double> turn = unit_exponential<double>(h_ * of.w);
        new_point = centre + h_ * of.v + turn * Vector3d(point - centre);
        for (int k = 0; k < 3; ++k) new_axes.col(k) = turn * Vector3d(axes.col(k));
    };
    move(a, pose_.centre_a, pose_.point_a, pose_.axes_a, end.point_a, end.axes_a);
    move(b, pose_.centre_b, pose_.point_b, pose_.axes_b, end.point_b, end.axes_b);
    end.centre_a = end.centre_b = Vector3d::Zero();
    const double more = joint_coordinate(*joint_, end, axis_).value - q_.value - h_ * rate_of(a, b);
    if (axis_ < kTurnX) return more;
    const double less = std::remainder(more, 2 * kHalfTurn);
    return std::abs(less) < kFarthestTurn ? less : 0;
}

/// Steps at the limit follow it.
void DrivenAxis::move_limit(double turned) {
    const DriveRow& limit = drive_.rows[limit_];
    const double before = -limit.bias;
    drive_ = {};
    for (std::uint32_t i = 0; i < last_ - first_; ++i) {
        DriveRow row = rows_[i];
        if (static_cast<int>(i) == limit_) row.bias += turned / h_;
        drive_.add(row);
    }
    for (AxisAnswer* answer : {&answer_, &next_})
        if (answer->is_step && answer->rate == before) answer->rate = -limit.bias;
}

void DrivenAxis::start_from(const Velocity<double>& a, const Velocity<double>& b) {
    start_ = rate_of(a, b);
    if (turns()) move_limit(turned(a, b));
}

void DrivenAxis::look(const Velocity<double>& a, const Velocity<double>& b, bool same_piece) {
    off_ = 0;
    if (!(response_ > 0)) return;
    const double rate = rate_of(a, b);
    if (++looks_ > 1) learn_response(rate);
    impulse_before_ = impulse_;
    rate_ = rate;
    next_ = same_piece ? answer_ : answer_of(drive_, rate_, impulse_, response_);
    if (next_.is_row())
        off_ = h_ * std::abs(wish(next_, impulse_) - rate_) * response_ /
               (response_ + softness(next_));
    else if (std::abs(next_.impulse - impulse_) > kImpulseRounding * std::abs(impulse_))
        off_ = std::numeric_limits<double>::infinity();
}

/// All that hangs together moves with the axis, which makes it heavier than its two bodies. How
/// heavy the last Newton step has shown; without that, axes that are bounded may go round between
/// the same few pieces for ever.
void DrivenAxis::learn_response(double rate) {
    const double shown = (rate - rate_) / (impulse_ - impulse_before_);
    if (shown > 0) response_ = std::clamp(shown, kLeastShare * bare_, bare_);
}

void DrivenAxis::add_row(RowsElimination<double>& e, double sign, bool balance) const {
    if (is_row())
        append_row<double>(e, q_.along, q_.turn_a, q_.turn_b, sign, softness(answer_),
                           wish(answer_, balance ? 0 : impulse_) - start_);
}

/// The rate that the row of an answer asks for beside an impulse.
double DrivenAxis::wish(const AxisAnswer& from, double impulse) {
    return from.rate + softness(from) * (from.impulse - impulse);
}

void DrivenAxis::push_child(BodyBlock<double>& child, double sign, bool balance) const {
    if (!is_row()) push(child, q_.along, sign > 0 ? q_.turn_a : q_.turn_b, sign * missing(balance));
}
void DrivenAxis::push_parent(BodyBlock<double>& parent, double sign, bool balance) const {
    if (!is_row())
        push(parent, q_.along, sign > 0 ? q_.turn_b : q_.turn_a, -sign * missing(balance));
}

void DrivenAxis::take_impulse(const RowsElimination<double>& e, int& row, bool balance) {
    if (is_row())
        impulse_ = (balance ? 0 : impulse_) + e.lambda[row++];
    else
        impulse_ = answer_.impulse;
}

void DrivenAxis::store_impulses(JointTable& joints) {
    double shares[AxisDrive::kMostRows] = {};
    AxisAnswer last = next_;
    last.impulse = impulse_;
    share_impulse(drive_, last, shares);
    for (std::uint32_t i = first_, row = 0; i < last_; ++i) {
        JointDrive& drive = joints.drives[i];
        drive.impulse_before = drive.impulse;
        drive.impulse = shares[row++], drive.axis_impulse = impulse_;
    }
}

}  // namespace plumb
