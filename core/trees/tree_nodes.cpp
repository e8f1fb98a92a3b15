// SPDX-License-Identifier: MIT
#include "trees/tree_nodes.h"

#include "constraints/tension_rows.h"
#include "math/rotation.h"
#include "ties/driven_axes.h"
#include "ties/joint_geometry.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

const Vector3d kZero = Vector3d::Zero();

template <int N>
double* row_at(std::vector<double>& table, std::uint32_t node) {
    return table.data() + std::size_t(node) * N;
}

void put_velocity(std::vector<double>& table, std::uint32_t node, const Velocity<double>& x) {
    double* row = row_at<kTreeVelocity>(table, node);
    for (int k = 0; k < 3; ++k) row[k] = x.v[k], row[4 + k] = x.w[k];
}
Velocity<double> velocity_of(std::vector<double>& table, std::uint32_t node) {
    const double* x = row_at<kTreeVelocity>(table, node);
    return {{x[0], x[1], x[2]}, {x[4], x[5], x[6]}};
}

double (&share_row(std::vector<double>& table, std::uint32_t node))[kShareNumbers] {
    return *reinterpret_cast<double(*)[kShareNumbers]>(row_at<kShareNumbers>(table, node));
}

/// What is not a number is the greatest.
double greater(double a, double b) { return b > a || std::isnan(b) ? b : a; }

}  // namespace

TreeNodes::TreeNodes(const World& world, const JointForest& forest,
                     const std::vector<std::uint8_t>& side_by_side, const TreeProgress& progress,
                     TreeTables& tables)
    : progress_(progress),
      tables_(tables),
      index_(forest.nodes.size(), 0),
      carries_balls_(std::find(side_by_side.begin(), side_by_side.end(), 1) != side_by_side.end()) {
    for (std::uint32_t i = 0; i < forest.nodes.size(); ++i) {
        if (side_by_side[i]) continue;
        const ForestNode& from = forest.nodes[i];
        index_[i] = static_cast<std::uint32_t>(nodes_.size());
        Node& node = nodes_.emplace_back();
        node.node = i, node.row = from.row, node.body = world.body_of_row[from.row];
        node.joint = from.joint, node.free = from.parent == kFree;
        node.hung = progress.hangs(i);
        node.parent = from.parent >= 0 ? static_cast<std::uint32_t>(from.parent) : tables.ground;
        if (node.free) continue;
        const Joint& joint = world.joints.joints[node.joint];
        node.sign = joint.a == node.body ? 1 : -1;
        add_axes(world, node);
    }
}

void TreeNodes::add_axes(const World& world, Node& node) {
    each_driven_axis(world.joints, node.joint, [&](std::uint32_t first, std::uint32_t last) {
        node.axes.emplace_back(world.joints, first, last);
    });
}

void TreeNodes::load_impulses(const JointTable& joints) {
    for (Node& node : nodes_) {
        if (node.free) continue;
        const Joint& joint = joints.joints[node.joint];
        std::copy(joint.rows.begin(), joint.rows.end(), node.lambda);
        for (DrivenAxis& axis : node.axes) axis.load_impulse(joints);
    }
}

void TreeNodes::begin(const World& world, const SubstepTime& time, const Vector3d& lift) {
    h_ = time.h, inverse_h_ = 1 / h_;
    const Bodies& b = world.bodies;
    for (Node& node : nodes_) {
        node.mass = b.mass[node.body];
        node.inertia =
            rotated_diagonal(b.orientation[node.body].toRotationMatrix(), b.inertia[node.body]);
        node.start = {{b.velocity[node.body], b.angular_velocity[node.body]}};
        node.given = node.written = node.held = {{kZero, kZero}};
        node.own = {{node.hung ? lift : kZero, kZero}};
        if (!node.free) begin_joint(world, node, time);
    }
}

void TreeNodes::rest_left_out() {
    for (Node& node : nodes_)
        if (progress_.is_left_out(node.node)) node.own = {{kZero, kZero}};
}

void TreeNodes::begin_joint(const World& world, Node& node, const SubstepTime& time) {
    const Bodies& b = world.bodies;
    const Joint& joint = world.joints.joints[node.joint];
    const std::uint32_t other = node.sign > 0 ? joint.b : joint.a;
    if (other != kNoIndex && b.motion[other] != Motion::dynamic)
        node.held = {{b.velocity[other], b.angular_velocity[other]}};
    node.geometry = loaded_joint_geometry(world, joint, JointSolve::tree, time);
    defer_errors(node.deferred, node.old, node.geometry, h_ * world.settings.recovery_speed);
    for (DrivenAxis& axis : node.axes) axis.begin(world, time);
}

void TreeNodes::keep(std::uint32_t index) {
    Node& node = nodes_[index_[index]];
    node.kept_own = node.own;
    std::copy(std::begin(node.lambda), std::end(node.lambda), node.kept_lambda);
}
void TreeNodes::take_back(std::uint32_t index) {
    Node& node = nodes_[index_[index]];
    node.own = node.kept_own;
    std::copy(std::begin(node.kept_lambda), std::end(node.kept_lambda), node.lambda);
}

void TreeNodes::forget(std::uint32_t index) {
    Node& node = nodes_[index_[index]];
    node.own = {{kZero, kZero}};
    std::fill(std::begin(node.lambda), std::end(node.lambda), 0.0);
    for (DrivenAxis& axis : node.axes) axis.forget();
}

void TreeNodes::turn_levers_to_the_end(std::uint32_t index) {
    Node& node = nodes_[index_[index]];
    if (node.free) return;
    node.lever() = {1, kZero};
    node.other_lever() = {node.parent != tables_.ground ? 1.0 : 0.0, kZero};
    if (node.geometry.length > 0) node.geometry.line_share = 1, node.geometry.line_lag = kZero;
}

Velocity<double> TreeNodes::start_of(std::uint32_t index) const {
    const Node& node = nodes_[index_[index]];
    return node.start + node.given;
}
Velocity<double> TreeNodes::own_of(std::uint32_t index) const { return nodes_[index_[index]].own; }
void TreeNodes::put_start(std::uint32_t index, const Velocity<double>& start) {
    Node& node = nodes_[index_[index]];
    node.given = Change{start} - node.start;
}
void TreeNodes::put_own(std::uint32_t index, const Velocity<double>& own) {
    nodes_[index_[index]].own = Change{own};
}

double TreeNodes::evaluate(std::uint32_t index, AxisLook look) {
    Node& node = nodes_[index_[index]];
    const Change own = node.start + node.given + node.own;
    put_velocity(tables_.velocity, node.node, own);
    if (carries_balls_) {
        const UnitQuaternion<double> turn = unit_exponential<double>(h_ * own.w);
        double* row = row_at<kTreeTurn>(tables_.turn, node.node);
        for (int k = 0; k < 3; ++k) row[k] = turn.v[k];
        row[3] = turn.w;
    }
    if (node.free) return 0;
    const Velocity<double> other = velocity_beyond(node);
    const Velocity<double>&a = node.sign > 0 ? own : other, &b = node.sign > 0 ? other : own;
    const JointPreview<double> preview(node.geometry, a, b, h_);
    node.apart = preview.apart;
    joint_errors<double>(node.now.c, node.geometry, preview);
    for (int k = 0; k < 6; ++k) node.now.c[k] -= node.deferred[k];
    double worst = violation_of(node);
    for (DrivenAxis& axis : node.axes) {
        axis.start_from(a, b);
        if (look != AxisLook::before || axis.turns()) axis.look(a, b, look == AxisLook::same_piece);
        worst = greater(worst, axis.off());
    }
    return worst;
}

/// Of a body of the forest, when the step is made.
Velocity<double> TreeNodes::velocity_after(std::uint32_t node) const {
    const Velocity<double> x = velocity_of(tables_.velocity, node),
                           step = velocity_of(tables_.step, node);
    return {x.v + step.v, x.w + step.w};
}

std::uint32_t TreeNodes::look_at_axes(std::uint32_t index, double tolerance) {
    Node& node = nodes_[index_[index]];
    if (node.axes.empty()) return 0;
    const Velocity<double> own = velocity_after(node.node);
    const Velocity<double> other =
        node.parent == tables_.ground ? Velocity<double>(node.held) : velocity_after(node.parent);
    std::uint32_t wrong = 0;
    for (DrivenAxis& axis : node.axes) {
        axis.look(node.sign > 0 ? own : other, node.sign > 0 ? other : own, false);
        wrong += axis.is_on_wrong_piece(tolerance);
    }
    return wrong;
}

std::uint32_t TreeNodes::change_pieces(std::uint32_t index, double tolerance, std::uint32_t most) {
    std::uint32_t changed = 0;
    for (DrivenAxis& axis : nodes_[index_[index]].axes) {
        const bool wrong = axis.is_on_wrong_piece(tolerance);
        if (wrong && changed == most) continue;
        axis.change_piece();
        changed += wrong;
    }
    return changed;
}

/// Of what the node's body hangs by.
Velocity<double> TreeNodes::velocity_beyond(const Node& node) const {
    if (node.parent == tables_.ground) return node.held;
    return velocity_of(tables_.velocity, node.parent);
}

/// Of the rows that the joint takes away [m], [rad].
double TreeNodes::violation_of(const Node& node) const {
    double worst = 0;
    for (int k = 0; k < 6; ++k)
        if (node.geometry.lock[k] > 0)
            worst = greater(
                worst, std::abs(node.now.c[k] + h_ * node.geometry.softness[k] * node.lambda[k]));
    return worst;
}

/// The rows at the poses of the last evaluation.
void TreeNodes::find_rows(Node& node) {
    const Velocity<double> own = velocity_of(tables_.velocity, node.node),
                           other = velocity_beyond(node);
    const Velocity<double>&a = node.sign > 0 ? own : other, &b = node.sign > 0 ? other : own;
    // a line pulls each body at its own point: what it turns by in the substep is no arm of either
    const double meet = node.geometry.length > 0 ? 0 : node.meet;
    joint_axes<double>(node.now, node.geometry, a, b, h_, node.apart, meet);
    take_rows(node.elimination, node.now, node.geometry, node.sign, inverse_h_);
    if (!(node.geometry.line_share > 0) || !(node.lambda[0] < 0)) return;
    const auto turned = [this](const Vector3d& w, const Vector3d& arm) -> Vector3d {
        return unit_exponential<double>(h_ * w) * arm;
    };
    add_tension_rows<double>(node.elimination, node.now.e[0], turned(own.w, node.arm()),
                             turned(other.w, node.other_arm()),
                             -node.lambda[0] * node.geometry.line_share, node.geometry.length, h_);
}

/// With all that hangs on the body.
void TreeNodes::load_block(Node& node, bool balance, bool leaf) {
    TreeShare<double> whole =
        leaf ? TreeShare<double>::none() : share_of<double>(share_row(tables_.share, node.node));
    Symmetric3<double> stiffness{0, 0, 0, 0, 0, 0};
    if (!node.free)
        stiffness =
            angular_stiffness<double>(node.acting(), impulse_of(node), node.lever().share * h_);
    add_body<double>(whole, node.mass, node.inertia, stiffness, node.own, balance);
    node.block = whole.block;
}

/// Of the joint, on the child [N s].
Vector3d TreeNodes::impulse_of(const Node& node) {
    Vector3d impulse = kZero;
    for (int k = 0; k < 3; ++k)
        if (node.geometry.lock[k] > 0) impulse += node.now.e[k] * (node.sign * node.lambda[k]);
    return impulse;
}

void TreeNodes::eliminate(std::uint32_t index, bool balance, bool first, bool leaf) {
    Node& node = nodes_[index_[index]];
    if (!node.free) find_rows(node);
    load_block(node, balance, leaf);
    if (node.free) return;
    RowsElimination<double>& e = node.elimination;
    for (int k = 0, row = 0; k < 6; ++k) {
        if (!(node.geometry.lock[k] > 0)) continue;
        if (!balance) e.wish[row] -= e.softness[row] * node.lambda[k];
        ++row;
    }
    node.first_axis_row = e.n;
    for (const DrivenAxis& axis : node.axes) {
        axis.add_row(e, node.sign, balance);
        axis.push_child(node.block, node.sign, balance);
    }
    eliminate_rows(e, node.block);
    auto& row = share_row(tables_.share, node.parent);
    TreeShare<double> parent = first ? TreeShare<double>::none() : share_of<double>(row);
    add_rows(parent.block, e);
    for (const DrivenAxis& axis : node.axes) axis.push_parent(parent.block, node.sign, balance);
    parent.stiffness =
        parent.stiffness + angular_stiffness<double>(node.other_acting(), -impulse_of(node),
                                                     node.other_lever().share * h_);
    put_share(parent, row);
}

void TreeNodes::substitute(std::uint32_t index, bool balance) {
    Node& node = nodes_[index_[index]];
    const Velocity<double> step =
        node.free ? solve_block(node.block)
                  : substitute_rows(node.elimination, velocity_of(tables_.step, node.parent));
    node.own = node.own + Change{step};
    put_velocity(tables_.step, node.node, step);
    if (node.free) return;
    for (int k = 0, row = 0; k < 6; ++k)
        if (node.geometry.lock[k] > 0)
            node.lambda[k] = (balance ? 0 : node.lambda[k]) + node.elimination.lambda[row++];
    int row = node.first_axis_row;
    for (DrivenAxis& axis : node.axes) axis.take_impulse(node.elimination, row, balance);
}

void TreeNodes::store_impulses(JointTable& joints) {
    for (Node& node : nodes_) {
        if (node.free || progress_.is_left_out(node.node)) continue;
        Joint& joint = joints.joints[node.joint];
        joint.rows_before = joint.rows;
        std::copy(std::begin(node.lambda), std::end(node.lambda), joint.rows.begin());
        for (DrivenAxis& axis : node.axes) axis.store_impulses(joints);
    }
}

}  // namespace plumb
