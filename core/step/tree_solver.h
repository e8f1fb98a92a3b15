// SPDX-License-Identifier: MIT
/// Joints that form trees, solved exactly: Newton steps on
///
///   M (v − v*) = J(v)ᵀ λ,   C(v)/h + s λ = 0
///
/// with C and J at the preview poses, each by block LDLᵀ from the leaves to the roots and back, at
/// a cost linear in the number of bodies. v* is what forces, contacts and other joints make of the
/// velocity. Since J is that of the poses at the end of the substep, stiff trees (a light rod that
/// carries a heavy load) stay calm; Newton's matrix holds, beside M, how the joints' torques turn
/// with the bodies. Numbers are double, whatever the rows' precision.
#pragma once

#include "constraints/tree_block.h"
#include "schedule/contact_rows.h"
#include "schedule/joint_forest.h"
#include "world/world.h"

#include <vector>

namespace plumb {

class TreeSolver {
public:
    TreeSolver(const World& world, const JointForest& forest);

    /// Arms, gaps, masses and velocities at the start of a substep of length h [s].
    void begin(const World& world, double h);

    /// Newton steps until no row is violated by more than Settings::joint_tolerance.
    template <class Real>
    void solve(const BodyRows<Real>& rows) {
        for (Node& node : nodes_) node.given = read(rows.change, node.row) - node.own;
        solve();
        for (Node& node : nodes_) write(rows.change, node.row, node.given + node.own);
    }

    /// Impulses of the last substep, into Joint::rows.
    void store_impulses(JointTable& joints) const;

    std::uint64_t newton_steps() const { return newton_steps_; }  ///< since the start

private:
    struct Change : Velocity<double> {
        Change operator+(const Change& o) const { return {{v + o.v, w + o.w}}; }
        Change operator-(const Change& o) const { return {{v - o.v, w - o.w}}; }
    };

    /// A body and the joint that it hangs by.
    struct Node {
        std::int32_t row, parent;
        std::uint32_t body, joint;
        std::int32_t rows;  ///< index into rows_; −1 of a plain ball
        double sign;        ///< 1 where the body is the joint's a, else −1
        double mass;
        Symmetric3<double> inertia;      ///< world frame, at the start [kg m²]
        Vector3d arm, parent_arm;        ///< of the joint's point, at the start [m]
        double follow, parent_follow;    ///< share of the turn that an impulse goes along with
        Vector3d apart;                  ///< child's point − parent's, at the start [m]
        Change start;                    ///< velocity at the start, forces included
        Change given, own;               ///< changes by others, and by this solver
        Change held;                     ///< velocity of an immovable parent
        Vector3d held_shift;             ///< and how far it moves the point [m]
        Matrix3d turn;                   ///< exp(h ω) − 1
        Vector3d gap;                    ///< child's point − parent's, at the preview [m]
        Vector3d acting, parent_acting;  ///< arms by which the impulse acts [m]
        Vector3d impulse;                ///< of a ball, on the child [N s]
        Symmetric3<double> stiffness;    ///< of the turn, by the joints' impulses
        BodyBlock<double> block;
        BallElimination<double> ball;
        Velocity<double> step;  ///< Δv
    };

    /// What a joint of another kind than a plain ball has besides.
    struct Rows {
        JointGeometry<double> geometry;
        JointRows<double> now;
        RowsElimination<double> elimination;
        double lambda[6];  ///< along the joint's rows
    };

    template <class Real>
    static Change read(const Real* rows, std::int32_t row) {
        const Real* r = rows + static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
        return {{{double(r[0]), double(r[1]), double(r[2])},
                 {double(r[4]), double(r[5]), double(r[6])}}};
    }
    template <class Real>
    static void write(Real* rows, std::int32_t row, const Change& change) {
        Real* r = rows + static_cast<std::ptrdiff_t>(row) * kBodyRowSize;
        for (int k = 0; k < 3; ++k) {
            r[k] = static_cast<Real>(change.v[k]);
            r[4 + k] = static_cast<Real>(change.w[k]);
        }
    }

    void solve();
    void forget();
    void begin_node(const World& world, Node& node);
    void begin_rows(const World& world, const Joint& joint, const Node& node);

    double evaluate();
    double evaluate_ball(Node& node);
    double evaluate_rows(Node& node);
    static void place_impulse(Node& node, const Vector3d& change, const Vector3d& parent_change,
                              const Vector3d& gap);
    void stiffen(Node& node, const Vector3d& impulse);

    void eliminate(bool follow);
    void load_block(Node& node, bool follow) const;
    void substitute(bool follow);
    void substitute_ball_joint(Node& node, bool follow);
    void substitute_rows_joint(Node& node, bool follow);

    std::vector<Node> nodes_;  ///< parents before children
    std::vector<Rows> rows_;
    double h_ = 0, inverse_h_ = 0, tolerance_;
    bool fresh_ = true;  ///< no step was made in this substep
    std::uint64_t newton_steps_ = 0;
};

}  // namespace plumb
