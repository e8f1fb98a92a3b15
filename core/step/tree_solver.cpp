// SPDX-License-Identifier: MIT
#include "step/tree_solver.h"

#include "constraints/tension_rows.h"
#include "math/rotation.h"
#include "step/follow_share.h"
#include "step/joint_state.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Newton steps at the most; the first of them hold the balance of momentum at the end of the
/// substep, and if that does not succeed the others only close the joints.
constexpr int kMostSteps = 20, kBalancedSteps = 10;

/// exp(ϑ) − 1, for turns of any size.
Matrix3d turn_of(const Vector3d& theta) {
    const double x = theta.squaredNorm();
    if (x > 1) return exponential_map(theta).toRotationMatrix() - Matrix3d::Identity();
    double sine = 1, cosine = 0.5, term_sine = 1, term_cosine = 0.5;
    const int terms = x < 1e-4 ? 3 : 9;
    for (int k = 1; k <= terms; ++k) {
        term_sine *= -x * (1.0 / ((2 * k) * (2 * k + 1)));
        term_cosine *= -x * (1.0 / ((2 * k + 1) * (2 * k + 2)));
        sine += term_sine, cosine += term_cosine;
    }
    const Vector3d s = sine * theta, c = cosine * theta;
    Matrix3d m;
    m << c.x() * theta.x() - cosine * x, c.x() * theta.y() - s.z(), c.x() * theta.z() + s.y(),
        c.x() * theta.y() + s.z(), c.y() * theta.y() - cosine * x, c.y() * theta.z() - s.x(),
        c.x() * theta.z() - s.y(), c.y() * theta.z() + s.x(), c.z() * theta.z() - cosine * x;
    return m;
}

bool is_positive(const Symmetric3<double>& m) {
    const double minor = m.xx * m.yy - m.xy * m.xy;
    const double whole = m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.yz * m.xz) +
                         m.xz * (m.xy * m.yz - m.yy * m.xz);
    return m.xx > 0 && minor > 0 && whole > 0;
}

/// The part of a stiffness that can be trusted beside an inertia: all of it while the two leave at
/// least a quarter of the inertia, else what is not negative.
Symmetric3<double> safe_stiffness(const Symmetric3<double>& g, const Symmetric3<double>& inertia) {
    const double share = 0.75;
    if (is_positive(g + Symmetric3<double>{share * inertia.xx, share * inertia.yy,
                                           share * inertia.zz, share * inertia.xy,
                                           share * inertia.xz, share * inertia.yz}))
        return g;
    Matrix3d m;
    m << g.xx, g.xy, g.xz, g.xy, g.yy, g.yz, g.xz, g.yz, g.zz;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(m);
    return rotated_diagonal(solver.eigenvectors(), solver.eigenvalues().cwiseMax(0));
}

}  // namespace

TreeSolver::TreeSolver(const World& world, const JointForest& forest)
    : tolerance_(world.settings.joint_tolerance) {
    std::vector<std::uint32_t> body_of(static_cast<std::size_t>(world.dynamic_count));
    for (std::uint32_t i = 0; i < world.bodies.size(); ++i)
        if (world.bodies.motion[i] == Motion::dynamic) body_of[world.bodies.row[i]] = i;
    nodes_.reserve(forest.nodes.size());
    for (const ForestNode& from : forest.nodes) {
        Node& node = nodes_.emplace_back();
        node.row = from.row, node.parent = from.parent, node.joint = from.joint;
        node.body = body_of[from.row], node.rows = -1;
        if (node.parent != kFree) {
            const Joint& joint = world.joints.joints[node.joint];
            node.sign = joint.a == node.body ? 1 : -1;
            for (int k = 0; k < 3; ++k) node.impulse[k] = node.sign * joint.rows[k];
            if (!joint.is_plain_ball()) {
                node.rows = static_cast<std::int32_t>(rows_.size());
                std::copy(joint.rows.begin(), joint.rows.end(), rows_.emplace_back().lambda);
            }
        }
    }
}

void TreeSolver::begin(const World& world, double h) {
    h_ = h, inverse_h_ = 1 / h;
    fresh_ = true;
    for (Node& node : nodes_) begin_node(world, node);
}

void TreeSolver::begin_node(const World& world, Node& node) {
    const Bodies& b = world.bodies;
    node.mass = b.mass[node.body];
    node.inertia =
        rotated_diagonal(b.orientation[node.body].toRotationMatrix(), b.inertia[node.body]);
    node.start = {{b.velocity[node.body], b.angular_velocity[node.body]}};
    node.own = {{Vector3d::Zero(), Vector3d::Zero()}};
    if (node.parent == kFree) return;
    const Joint& joint = world.joints.joints[node.joint];
    const bool is_a = node.sign > 0;
    const std::uint32_t other = is_a ? joint.b : joint.a;
    const auto point = [&](std::uint32_t body, const Placement& frame, Vector3d& arm) -> Vector3d {
        if (body == kNoIndex) return arm = Vector3d::Zero(), frame.position;
        arm = b.orientation[body] * frame.position;
        return b.position[body] + arm;
    };
    const Vector3d own_point = point(node.body, is_a ? joint.frame_a : joint.frame_b, node.arm);
    node.apart = own_point - point(other, is_a ? joint.frame_b : joint.frame_a, node.parent_arm);
    node.follow = follow_share(world, joint, node.body, node.arm, h_);
    node.parent_follow = follow_share(world, joint, other, node.parent_arm, h_);
    if (node.parent == kHeld) {
        node.held = {{Vector3d::Zero(), Vector3d::Zero()}};
        if (other != kNoIndex && b.motion[other] != Motion::fixed)
            node.held = {{b.velocity[other], b.angular_velocity[other]}};
        node.held_shift = h_ * node.held.v + turn_of(h_ * node.held.w) * node.parent_arm;
    }
    if (node.rows >= 0) begin_rows(world, joint, node);
}

void TreeSolver::begin_rows(const World& world, const Joint& joint, const Node& node) {
    const JointPose pose = joint_pose(world.bodies, joint);
    JointGeometry<double>& g = rows_[node.rows].geometry;
    g.r_a = pose.point_a - pose.centre_a;
    g.r_b =
        joint.b == kNoIndex ? Vector3d(Vector3d::Zero()) : Vector3d(pose.point_b - pose.centre_b);
    g.apart = pose.point_a - pose.point_b;
    for (int k = 0; k < 3; ++k) {
        g.e[k] = pose.axes_b.col(k);
        g.u[k] = world.bodies.orientation[joint.a] * joint.turns[k].u;
        g.w[k] = joint.turns[k].w;
        if (joint.b != kNoIndex) g.w[k] = world.bodies.orientation[joint.b] * g.w[k];
    }
    for (std::uint32_t k = 0; k < kJointAxes; ++k) {
        const double alpha = k < kTurnX ? joint.compliance : joint.angular_compliance;
        g.lock[k] = joint.locked[k] && !joint.broken;
        g.softness[k] = alpha * inverse_h_ * inverse_h_;
    }
    g.follow_a = node.sign > 0 ? node.follow : node.parent_follow;
    g.follow_b = node.sign > 0 ? node.parent_follow : node.follow;
    g.length = joint.locked[kAlongX] ? joint.length : 0;
}

void TreeSolver::solve() {
    for (int step = 0; step < kMostSteps; ++step) {
        const bool converged = evaluate() <= tolerance_;
        if (converged && !fresh_) return;
        fresh_ = false;
        const bool follow = step < kBalancedSteps;
        if (step == kBalancedSteps) forget();
        eliminate(follow);
        substitute(follow);
        ++newton_steps_;
    }
}

/// Back to v*, where a search that led nowhere began.
void TreeSolver::forget() {
    for (Node& node : nodes_) {
        node.own = {{Vector3d::Zero(), Vector3d::Zero()}};
        node.impulse.setZero();
    }
    for (Rows& rows : rows_) std::fill(std::begin(rows.lambda), std::end(rows.lambda), 0.0);
    evaluate();
}

/// Poses at the preview, how far they are off, and how stiff the joints' impulses make the turns.
/// Returns the greatest violation of a row [m], [rad].
double TreeSolver::evaluate() {
    double worst = 0;
    for (Node& node : nodes_) {
        node.turn = turn_of(h_ * (node.start.w + node.given.w + node.own.w));
        node.stiffness = {0, 0, 0, 0, 0, 0};
        if (node.parent == kFree) continue;
        worst = std::max(worst, node.rows < 0 ? evaluate_ball(node) : evaluate_rows(node));
    }
    return worst;
}

double TreeSolver::evaluate_ball(Node& node) {
    const Vector3d change = node.turn * node.arm;
    Vector3d parent_change = Vector3d::Zero();
    node.gap = node.apart + change + h_ * (node.start.v + node.given.v + node.own.v);
    if (node.parent >= 0) {
        const Node& parent = nodes_[node.parent];
        parent_change = parent.turn * node.parent_arm;
        node.gap -= parent_change + h_ * (parent.start.v + parent.given.v + parent.own.v);
    } else {
        node.gap -= node.held_shift;
    }
    place_impulse(node, change, parent_change, node.gap);
    stiffen(node, node.impulse);
    return std::max({std::abs(node.gap.x()), std::abs(node.gap.y()), std::abs(node.gap.z())});
}

/// Both bodies feel the impulse at one point, that of the joint's a.
void TreeSolver::place_impulse(Node& node, const Vector3d& change, const Vector3d& parent_change,
                               const Vector3d& gap) {
    node.acting = node.arm + node.follow * change;
    node.parent_acting = node.parent_arm + node.parent_follow * parent_change;
    if (node.sign > 0)
        node.parent_acting += node.apart + node.parent_follow * (gap - node.apart);
    else
        node.acting -= node.apart + node.follow * (gap - node.apart);
}

double TreeSolver::evaluate_rows(Node& node) {
    Rows& rows = rows_[node.rows];
    const Velocity<double> own = node.start + node.given + node.own;
    Velocity<double> other = node.held;
    if (node.parent >= 0) {
        const Node& parent = nodes_[node.parent];
        other = parent.start + parent.given + parent.own;
    }
    const bool is_a = node.sign > 0;
    rows.now = joint_rows<double>(rows.geometry, is_a ? own : other, is_a ? other : own, h_);
    take_rows(rows.elimination, rows.now, rows.geometry, node.sign, inverse_h_);
    const Vector3d parent_change = node.parent >= 0
                                       ? Vector3d(nodes_[node.parent].turn * node.parent_arm)
                                       : Vector3d(Vector3d::Zero());
    const Vector3d change = node.turn * node.arm;
    place_impulse(node, change, parent_change, node.apart);
    if (rows.geometry.length > 0 && rows.lambda[0] < 0)
        add_tension_rows<double>(rows.elimination, rows.now.e[0], node.arm + change,
                                 node.parent_arm + parent_change, -rows.lambda[0],
                                 rows.geometry.length, h_);
    Vector3d impulse = Vector3d::Zero();
    double worst = 0;
    for (int k = 0; k < 6; ++k) {
        if (!(rows.geometry.lock[k] > 0)) continue;
        worst = std::max(worst,
                         std::abs(rows.now.c[k] + h_ * rows.geometry.softness[k] * rows.lambda[k]));
        if (k < 3) impulse += rows.now.e[k] * (node.sign * rows.lambda[k]);
    }
    stiffen(node, impulse);
    return worst;
}

void TreeSolver::stiffen(Node& node, const Vector3d& impulse) {
    if (node.follow > 0)
        node.stiffness =
            node.stiffness + turning_stiffness<double>(node.acting, impulse, node.follow * h_);
    if (node.parent < 0 || !(node.parent_follow > 0)) return;
    Symmetric3<double>& parent = nodes_[node.parent].stiffness;
    parent =
        parent + turning_stiffness<double>(node.parent_acting, -impulse, node.parent_follow * h_);
}

/// From the leaves to the roots. `follow`: λ is found anew, so that M (v − v*) = Jᵀ λ holds with
/// this J; else what is missing is added.
void TreeSolver::eliminate(bool follow) {
    for (Node& node : nodes_) load_block(node, follow);
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.parent == kFree) continue;
        if (node.rows >= 0) {
            Rows& rows = rows_[node.rows];
            RowsElimination<double>& e = rows.elimination;
            for (int k = 0, row = 0; k < 6; ++k) {
                if (!(rows.geometry.lock[k] > 0)) continue;
                if (!follow) e.wish[row] -= e.softness[row] * rows.lambda[k];
                ++row;
            }
            eliminate_rows(e, node.block);
            if (node.parent >= 0) add_rows(nodes_[node.parent].block, e);
            continue;
        }
        node.ball = eliminate_ball(node.block, node.acting);
        if (node.parent < 0) continue;
        const Vector3d push = node.ball.free + node.ball.mass * Vector3d(node.gap * inverse_h_);
        add_at_point(nodes_[node.parent].block, node.ball.mass, node.parent_acting, push);
    }
}

void TreeSolver::load_block(Node& node, bool follow) const {
    BodyBlock<double>& block = node.block;
    block.a = {node.mass, node.mass, node.mass, 0, 0, 0};
    block.d = node.inertia;
    for (Vector3d& column : block.b) column.setZero();
    if (follow) {
        block.d = block.d + safe_stiffness(node.stiffness, node.inertia);
        block.f = -node.mass * node.own.v;
        block.t = -(node.inertia * node.own.w);
    } else {
        block.f.setZero(), block.t.setZero();
    }
}

/// From the roots to the leaves.
void TreeSolver::substitute(bool follow) {
    for (Node& node : nodes_) {
        if (node.parent == kFree)
            node.step = solve_block(node.block);
        else if (node.rows >= 0)
            substitute_rows_joint(node, follow);
        else
            substitute_ball_joint(node, follow);
        node.own.v += node.step.v, node.own.w += node.step.w;
    }
}

void TreeSolver::substitute_ball_joint(Node& node, bool follow) {
    Vector3d point = -node.gap * inverse_h_;
    if (node.parent >= 0) point += velocity_at(nodes_[node.parent].step, node.parent_acting);
    node.step = substitute_ball(node.ball, node.acting, point);
    const Vector3d impulse = node.ball.mass * point - node.ball.free;
    node.impulse = follow ? impulse : Vector3d(node.impulse + impulse);
}

void TreeSolver::substitute_rows_joint(Node& node, bool follow) {
    Rows& rows = rows_[node.rows];
    Velocity<double> parent{Vector3d::Zero(), Vector3d::Zero()};
    if (node.parent >= 0) parent = nodes_[node.parent].step;
    node.step = substitute_rows(rows.elimination, parent);
    for (int k = 0, row = 0; k < 6; ++k)
        if (rows.geometry.lock[k] > 0)
            rows.lambda[k] = (follow ? 0 : rows.lambda[k]) + rows.elimination.lambda[row++];
}

void TreeSolver::store_impulses(JointTable& joints) const {
    for (const Node& node : nodes_) {
        if (node.parent == kFree) continue;
        Joint& joint = joints.joints[node.joint];
        for (std::uint32_t k = 0; k < kJointAxes; ++k)
            joint.rows[k] = node.rows >= 0 ? rows_[node.rows].lambda[k]
                            : k < 3        ? node.sign * node.impulse[k]
                                           : 0;
    }
}

}  // namespace plumb
