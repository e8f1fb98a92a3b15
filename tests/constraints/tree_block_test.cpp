// SPDX-License-Identifier: MIT
/// Elimination along trees against the whole system [M −Jᵀ; J s] solved densely.
#include "constraints/tree_block.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

namespace plumb {
namespace {

using test::Random;
constexpr double kStep = 0.01;
constexpr int kHeld = -1, kFree = -2;

/// Of a drive, or of tension.
struct SoftRow {
    Vector3d along, on_a, on_b;
    double softness, wish;
};

/// A body and its joint, which is a ball between two points or any rows at all.
struct Node {
    int parent = kFree;
    bool is_ball = false;
    double sign = 1;
    Vector3d arm, parent_arm, gap;
    JointGeometry<double> geometry{};
    JointRows<double> rows;
    std::vector<SoftRow> more;
    BodyBlock<double> body, block;  ///< as it is, and with all that hangs on it
    BallElimination<double> ball;
    RowsElimination<double> elimination;
    Velocity<double> step;
    Eigen::VectorXd lambda;  ///< on the child, of a ball
};

Velocity<double> random_velocity(Random& random) { return {random.vector(), random.vector()}; }

void take_random_rows(Node& node, Random& random) {
    JointGeometry<double>& g = node.geometry;
    g.r_a = random.vector(), g.r_b = random.vector(), g.apart = random.vector(0.01);
    const Matrix3d axes = random.rotation().toRotationMatrix();
    for (int k = 0; k < 3; ++k) {
        g.e[k] = axes.col(k);
        g.u[k] = axes.col((k + 1) % 3), g.w[k] = axes.col((k + 2) % 3);
    }
    const bool soft = random.below(3) == 0;
    for (int k = 0; k < 6; ++k)
        g.lock[k] = random.below(2), g.softness[k] = soft ? random.number(0, 0.5) : 0;
    g.lock[random.below(6)] = 1;
    g.lever_a = {random.number(0, 1), Vector3d::Zero()};
    g.lever_b = {random.number(0, 1), Vector3d::Zero()};
    g.length = g.line_share = 0, g.line_lag = Vector3d::Zero();
    node.rows = joint_rows<double>(g, random_velocity(random), random_velocity(random), kStep);
    node.sign = random.below(2) ? 1 : -1;
    take_rows(node.elimination, node.rows, g, node.sign, 1 / kStep);
    if (random.below(3) > 0) return;
    while (node.elimination.n < kMostTreeRows) {
        const SoftRow row{random.vector(), random.vector(), random.vector(),
                          random.number(0.1, 0.5), random.number(-1, 1)};
        append_row<double>(node.elimination, row.along, row.on_a, row.on_b, node.sign, row.softness,
                           row.wish);
        node.more.push_back(row);
    }
}

std::vector<Node> random_tree(Random& random, int bodies) {
    std::vector<Node> nodes(static_cast<std::size_t>(bodies));
    for (int i = 0; i < bodies; ++i) {
        Node& node = nodes[static_cast<std::size_t>(i)];
        const double mass = random.number(0.1, 10);
        node.body.a = {mass, mass, mass, 0, 0, 0};
        node.body.d = test::symmetric(random.tensor());
        for (Vector3d& column : node.body.b) column.setZero();
        node.body.f = random.vector(), node.body.t = random.vector();
        node.parent = i == 0 ? (random.below(2) ? kHeld : kFree)
                             : static_cast<int>(random.below(static_cast<std::uint32_t>(i)));
        node.is_ball = random.below(2) == 0;
        node.arm = random.vector(), node.parent_arm = random.vector();
        node.gap = random.vector(0.01);
        if (!node.is_ball) take_random_rows(node, random);
    }
    return nodes;
}

void solve_by_elimination(std::vector<Node>& nodes) {
    for (Node& node : nodes) node.block = node.body;
    for (std::size_t i = nodes.size(); i-- > 0;) {
        Node& node = nodes[i];
        if (node.parent == kFree) continue;
        Node* parent = node.parent >= 0 ? &nodes[static_cast<std::size_t>(node.parent)] : nullptr;
        if (node.is_ball) {
            node.ball = eliminate_ball(node.block, node.arm);
            const Vector3d push = node.ball.free + node.ball.mass * Vector3d(node.gap / kStep);
            if (parent) add_at_point(parent->block, node.ball.mass, node.parent_arm, push);
        } else {
            eliminate_rows(node.elimination, node.block);
            if (parent) add_rows(parent->block, node.elimination);
        }
    }
    for (Node& node : nodes) {
        Velocity<double> parent{Vector3d::Zero(), Vector3d::Zero()};
        if (node.parent >= 0) parent = nodes[static_cast<std::size_t>(node.parent)].step;
        if (node.parent == kFree) {
            node.step = solve_block(node.block);
        } else if (node.is_ball) {
            const Vector3d u = velocity_at(parent, node.parent_arm) - node.gap / kStep;
            node.step = substitute_ball(node.ball, node.arm, u);
            node.lambda = node.ball.mass * u - node.ball.free;
        } else {
            node.step = substitute_rows(node.elimination, parent);
            node.lambda = Eigen::Map<Eigen::VectorXd>(node.elimination.lambda, node.elimination.n);
        }
    }
}

/// J of a node's joint on its own body and on its parent, s and d, from the definitions.
struct DenseRows {
    Eigen::MatrixXd child, parent;
    Eigen::VectorXd softness, wish;
};

DenseRows dense_rows(const Node& node) {
    DenseRows r;
    if (node.is_ball) {
        r.child.resize(3, 6), r.parent.resize(3, 6);
        r.child << Matrix3d::Identity(), -test::skew(node.arm);
        r.parent << -Matrix3d::Identity(), test::skew(node.parent_arm);
        r.softness = Eigen::VectorXd::Zero(3);
        r.wish = -node.gap / kStep;
        return r;
    }
    std::vector<int> locked;
    for (int k = 0; k < 6; ++k)
        if (node.geometry.lock[k] > 0) locked.push_back(k);
    const auto n = static_cast<Eigen::Index>(locked.size() + node.more.size());
    r.child.setZero(n, 6), r.parent.setZero(n, 6), r.softness.resize(n), r.wish.resize(n);
    Eigen::Index row = 0;
    const auto add = [&](const SoftRow& x) {
        Eigen::Matrix<double, 1, 6> on_a, on_b;
        on_a << x.along.transpose(), x.on_a.transpose();
        on_b << -x.along.transpose(), -x.on_b.transpose();
        r.child.row(row) = node.sign > 0 ? on_a : on_b;
        r.parent.row(row) = node.sign > 0 ? on_b : on_a;
        r.softness[row] = x.softness, r.wish[row] = x.wish;
        ++row;
    };
    for (const int k : locked)
        add({k < 3 ? node.rows.e[k] : Vector3d::Zero(), node.rows.g_a[k], node.rows.g_b[k],
             node.geometry.softness[k], -node.rows.c[k] / kStep});
    for (const SoftRow& x : node.more) add(x);
    return r;
}

/// Δv of all bodies, then λ of all joints.
Eigen::VectorXd solve_densely(const std::vector<Node>& nodes) {
    Eigen::Index size = 6 * static_cast<Eigen::Index>(nodes.size());
    for (const Node& node : nodes)
        if (node.parent != kFree) size += dense_rows(node).wish.size();
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(size);
    Eigen::Index at = 6 * static_cast<Eigen::Index>(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Node& node = nodes[i];
        const auto own = 6 * static_cast<Eigen::Index>(i);
        k.block<3, 3>(own, own) = test::full(node.body.a);
        k.block<3, 3>(own + 3, own + 3) = test::full(node.body.d);
        rhs.segment<3>(own) = node.body.f, rhs.segment<3>(own + 3) = node.body.t;
        if (node.parent == kFree) continue;
        const DenseRows r = dense_rows(node);
        const Eigen::Index n = r.wish.size();
        k.block(at, own, n, 6) = r.child;
        k.block(own, at, 6, n) = -r.child.transpose();
        if (node.parent >= 0) {
            k.block(at, 6 * node.parent, n, 6) = r.parent;
            k.block(6 * node.parent, at, 6, n) = -r.parent.transpose();
        }
        k.block(at, at, n, n) = r.softness.asDiagonal();
        rhs.segment(at, n) = r.wish;
        at += n;
    }
    return k.fullPivLu().solve(rhs);
}

TEST(TreeBlock, AgreesWithADenseSolveOfTheWholeSystem) {
    Random random(11);
    for (int round = 0; round < 50; ++round) {
        std::vector<Node> nodes = random_tree(random, 1 + round % 20);
        const Eigen::VectorXd exact = solve_densely(nodes);
        solve_by_elimination(nodes);
        const double scale = exact.lpNorm<Eigen::Infinity>();
        Eigen::Index at = 6 * static_cast<Eigen::Index>(nodes.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const auto own = 6 * static_cast<Eigen::Index>(i);
            EXPECT_LT((nodes[i].step.v - exact.segment<3>(own)).norm(), 1e-10 * scale);
            EXPECT_LT((nodes[i].step.w - exact.segment<3>(own + 3)).norm(), 1e-10 * scale);
            if (nodes[i].parent == kFree) continue;
            const Eigen::Index n = nodes[i].lambda.size();
            EXPECT_LT((nodes[i].lambda - exact.segment(at, n)).norm(), 1e-10 * scale);
            at += n;
        }
        EXPECT_EQ(at, exact.size());
    }
}

/// The torque of an impulse that rides on a body falls as the body turns: by differences.
TEST(TreeBlock, TheStiffnessOfATurnIsTheDerivativeOfTheTorque) {
    Random random(5);
    const Vector3d arm = random.vector(), impulse = random.vector();
    constexpr double kTurn = 1e-6;
    Matrix3d slope;
    for (int k = 0; k < 3; ++k) {
        const Vector3d change = Turn<double>(Vector3d::Unit(k) * kTurn).change(arm);
        slope.col(k) = -change.cross(impulse) / kTurn * kStep;
    }
    const Matrix3d even = 0.5 * (slope + slope.transpose());
    EXPECT_LT((test::full(angular_stiffness<double>(arm, impulse, kStep)) - even).norm(),
              1e-5 * even.norm());
}

}  // namespace
}  // namespace plumb
