// SPDX-License-Identifier: MIT
/// Bodies of trees that are solved one by one: those that hang by a joint of another kind than a
/// plain ball or by one that is driven, and roots that hang by nothing. Numbers are double.
#pragma once

#include "constraints/tree_block.h"
#include "schedule/contact_rows.h"
#include "schedule/joint_forest.h"
#include "schedule/tree_blocks.h"
#include "solve/velocity_table.h"
#include "trees/driven_axis.h"
#include "trees/tree_progress.h"
#include "world/world.h"

#include <vector>

namespace plumb {

class TreeNodes {
public:
    /// `tables` outlives this.
    TreeNodes(const World& world, const JointForest& forest,
              const std::vector<std::uint8_t>& side_by_side, const TreeProgress& progress,
              TreeTables& tables);

    /// What the last substep left as the guess of the next.
    void load_impulses(const JointTable& joints);
    void begin(const World& world, const SubstepTime& time, const Vector3d& lift);

    void rest_left_out();

    /// Calls visit(node, body, its velocity at the start [m/s]).
    template <class Visit>
    void each_body(Visit visit) const {
        for (const Node& node : nodes_) visit(node.node, node.body, node.start.v);
    }

    // of one body of the forest; what they do is said in trees/tree_solver.h

    double evaluate(std::uint32_t node, AxisLook look);  ///< returns the greatest violation
    /// After a step, before poses are evaluated; returns how many are on a wrong piece.
    std::uint32_t look_at_axes(std::uint32_t node, double tolerance);
    /// Of `most` axes at the most; returns of how many.
    std::uint32_t change_pieces(std::uint32_t node, double tolerance, std::uint32_t most);
    void eliminate(std::uint32_t node, bool balance, bool first, bool leaf);
    void substitute(std::uint32_t node, bool balance);

    void keep(std::uint32_t node);
    void take_back(std::uint32_t node);
    void forget(std::uint32_t node);
    void turn_levers_to_the_end(std::uint32_t node);
    std::uint32_t body_of(std::uint32_t node) const { return nodes_[index_[node]].body; }
    Velocity<double> start_of(std::uint32_t node) const;
    Velocity<double> own_of(std::uint32_t node) const;
    void put_start(std::uint32_t node, const Velocity<double>& start);
    void put_own(std::uint32_t node, const Velocity<double>& own);
    void let_arms_meet(std::uint32_t node, double meet) { nodes_[index_[node]].meet = meet; }
    /// Calls change(row, its error at the start, the part of that that is left for later).
    template <class Change>
    void change_deferred(std::uint32_t node, Change change) {
        Node& of = nodes_[index_[node]];
        for (int k = 0; k < 6 && !of.free; ++k) change(k, of.old[k], of.deferred[k]);
    }
    void store_impulses(JointTable& joints);  ///< of those that are not left out

    template <class Real>
    void take(const BodyRows<Real>& rows) {
        for (Node& node : nodes_)
            node.given = node.given + (read(rows.change, node.row) - node.written);
    }
    // as in trees/tree_solver.h
    template <class RateOf>
    double correct_rates(RateOf rate_of) {
        double most = 0;
        for (Node& node : nodes_) {
            const Vector3d start = rate_of(node.body, node.own.w) - node.own.w;
            most = std::max(most, (start - node.start.w).norm());
            node.start.w = start;
        }
        return most;
    }
    void take_velocities(Bodies& bodies) const {
        for (const Node& node : nodes_) {
            bodies.velocity[node.body] = node.start.v + node.own.v;
            bodies.turn_change[node.body] = node.own.w;
            bodies.angular_velocity[node.body] = node.start.w + node.own.w;
        }
    }
    void keep_share(double share) {
        for (Node& node : nodes_) {
            node.own = node.own.scaled(share);
            for (double& x : node.lambda) x = share > 0 ? share * x : 0;
        }
    }
    template <class Real>
    void give(const BodyRows<Real>& rows) {
        for (Node& node : nodes_) {
            write(rows.change, node.row, node.given + node.own);
            node.written = read(rows.change, node.row);
        }
    }

private:
    struct Change : Velocity<double> {
        Change operator+(const Change& o) const { return {{v + o.v, w + o.w}}; }
        Change operator-(const Change& o) const { return {{v - o.v, w - o.w}}; }
        /// Nothing is left with a share of 0, also of what is not a number.
        Change scaled(double share) const {
            const Vector3d none = Vector3d::Zero();
            return share > 0 ? Change{{v * share, w * share}} : Change{{none, none}};
        }
    };

    /// A body, and the joint that it hangs by unless it is a free root.
    struct Node {
        std::uint32_t node, parent;  ///< rows in the tables
        std::int32_t row;            ///< in the velocity table
        std::uint32_t body, joint;
        bool free, hung;  ///< a root that hangs by nothing; the tree's root hangs by something
        double sign;      ///< 1 where the body is the joint's a, else −1
        double meet = 1;  ///< as of TreeBalls
        double mass;
        Symmetric3<double> inertia;  ///< world frame, at the start [kg m²]
        Vector3d apart;              ///< a's point − b's at the preview [m]
        Change start, held;          ///< velocity at the start; of an immovable parent
        Change given, own, written;  ///< changes by others, by this solver, and their sum when
                                     ///< it was handed on
        JointGeometry<double> geometry;
        JointRows<double> now;
        RowsElimination<double> elimination;
        double old[6];       ///< error of the rows at the start [m], [rad]
        double deferred[6];  ///< part of it that is left for later
        double lambda[6];    ///< along the joint's rows
        Change kept_own;     ///< where the step begins, as the next
        double kept_lambda[6];
        std::vector<DrivenAxis> axes;  ///< that the joint leaves free
        int first_axis_row;            ///< of theirs in `elimination`
        BodyBlock<double> block;

        const Vector3d& arm() const { return sign > 0 ? geometry.r_a : geometry.r_b; }
        const Vector3d& other_arm() const { return sign > 0 ? geometry.r_b : geometry.r_a; }
        const Vector3d& acting() const { return sign > 0 ? now.arm_a : now.arm_b; }
        const Vector3d& other_acting() const { return sign > 0 ? now.arm_b : now.arm_a; }
        JointLever<double>& lever() { return sign > 0 ? geometry.lever_a : geometry.lever_b; }
        JointLever<double>& other_lever() { return sign > 0 ? geometry.lever_b : geometry.lever_a; }
    };

    template <class Real>
    static Change read(const Real* rows, std::int32_t row) {
        const Velocity<Real> x = velocity_in(rows, row);
        return {{x.v.template cast<double>(), x.w.template cast<double>()}};
    }
    template <class Real>
    static void write(Real* rows, std::int32_t row, const Change& change) {
        put_velocity<Real>(rows, row,
                           {change.v.template cast<Real>(), change.w.template cast<Real>()});
    }

    static void add_axes(const World& world, Node& node);
    void begin_joint(const World& world, Node& node, const SubstepTime& time);
    Velocity<double> velocity_beyond(const Node& node) const;
    Velocity<double> velocity_after(std::uint32_t node) const;
    void find_rows(Node& node);
    double violation_of(const Node& node) const;
    void load_block(Node& node, bool balance, bool leaf);
    static Vector3d impulse_of(const Node& node);

    const TreeProgress& progress_;
    TreeTables& tables_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> index_;  ///< [node of the forest] in nodes_
    bool carries_balls_;  ///< whether bodies that are solved side by side may hang by these
    double h_ = 0, inverse_h_ = 0;
};

}  // namespace plumb
