// SPDX-License-Identifier: MIT
/// One axis of a tree's joint with all that drives it, as a row of the Newton steps that solve the
/// tree (step/tree_solver.h). Where the force law of constraints/axis_drive.h is flat, the impulse
/// is known and is no row.
#pragma once

#include "constraints/axis_drive.h"
#include "constraints/joint_axis.h"
#include "constraints/tree_block.h"
#include "world/world.h"

namespace plumb {

class DrivenAxis {
public:
    /// Drives [first, last) of JointTable::drives, which act on one axis of one joint.
    DrivenAxis(const JointTable& joints, std::uint32_t first, std::uint32_t last);

    /// Coordinate and rows at the start of a substep of length h [s].
    /// What the last substep left as the guess of the next.
    void load_impulse(const JointTable& joints);
    void begin(const World& world, const SubstepTime& time);
    void forget() { impulse_ = 0; }

    /// Looks at which piece of the force law the axis is, by the velocities of the joint's a and b.
    /// `settle`: it leaves a row for good where its impulse is beyond its bounds and goes nowhere
    /// else, so that the search ends. Returns how far off the axis is [m], [rad].
    double evaluate(const Velocity<double>& a, const Velocity<double>& b, bool settle);

    /// Adds its row, if it is one. `sign`: 1 where the child is the joint's a, else −1; `balance`
    /// as in TreeSolver::eliminate.
    void add_row(RowsElimination<double>& e, double sign, bool balance) const;
    /// Adds its impulse to what the child or the parent has to bear, if it is none.
    void push_child(BodyBlock<double>& child, double sign, bool balance) const;
    void push_parent(BodyBlock<double>& parent, double sign, bool balance) const;
    /// Takes over what the Newton step made of the impulse; `row`: the next of its rows.
    void take_impulse(const RowsElimination<double>& e, int& row, bool balance);

    void store_impulses(JointTable& joints);

private:
    bool is_row() const { return answer_.is_row(); }
    double softness() const { return answer_.is_step ? 0 : 1 / answer_.slope; }
    double wish(bool balance) const;
    void learn_response(double rate);
    /// What a flat piece still lacks.
    double missing(bool balance) const { return answer_.impulse - (balance ? 0 : impulse_); }

    std::uint32_t first_, last_;
    double h_ = 0;
    int looks_ = 0;  ///< evaluations in this substep
    AxisDrive drive_;
    JointCoordinate q_;
    double bare_ = 0;      ///< K of the two bodies while the joint holds; 0 where nothing can move
    double response_ = 0;  ///< K with all that hangs on them, as far as it is known
    double rate_ = 0, impulse_ = 0, impulse_before_ = 0;
    AxisAnswer answer_;
};

}  // namespace plumb
