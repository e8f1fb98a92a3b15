// SPDX-License-Identifier: MIT
/// One axis of a tree's joint with all that drives it, as a row of the Newton steps that solve the
/// tree (trees/tree_solver.h). Where the force law of constraints/axis_drive.h is flat, the impulse
/// is known and is no row.
///
/// A rate says where a coordinate comes to if the joint's axis keeps its direction. Where that
/// turns within the substep, as that of a slider on what swings, limits are asked for by what the
/// coordinate will be at the velocities that each Newton step begins from.
#pragma once

#include "constraints/axis_drive.h"
#include "constraints/joint_axis.h"
#include "constraints/tree_block.h"
#include "world/world.h"

namespace plumb {

/// How an axis is looked at: as the last step left it, anew, or as if it had to stay on the piece
/// of its force law on which it is.
enum class AxisLook { before, anew, same_piece };

class DrivenAxis {
public:
    /// Drives [first, last) of JointTable::drives, which act on one axis of one joint.
    DrivenAxis(const JointTable& joints, std::uint32_t first, std::uint32_t last);

    /// What the last substep left as the guess of the next.
    void load_impulse(const JointTable& joints);
    /// Coordinate and rows at the start of a substep of length h [s].
    void begin(const World& world, const SubstepTime& time);
    void forget() { impulse_ = 0; }

    /// Where the next Newton step begins: the velocities of the joint's a and b.
    void start_from(const Velocity<double>& a, const Velocity<double>& b);
    /// Looks on which piece of the force law the axis ought to be, by the velocities of the joint's
    /// a and b.
    void look(const Velocity<double>& a, const Velocity<double>& b, bool same_piece);
    double off() const { return off_; }  ///< from it [m], [rad]
    /// Whether limits have to be looked at anew at each place.
    bool turns() const { return limit_ >= 0; }
    /// Whether that is another piece than the one that the last Newton step was for, and farther
    /// off than the tolerance.
    bool is_on_wrong_piece(double tolerance) const {
        return off_ > tolerance && !next_.is_on_piece_of(answer_);
    }
    void change_piece() { answer_ = next_; }

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
    static double softness(const AxisAnswer& x) { return x.is_step ? 0 : 1 / x.slope; }
    static double wish(const AxisAnswer& from, double impulse);
    double rate_of(const Velocity<double>& a, const Velocity<double>& b) const;
    void learn_response(double rate);
    void find_limit(const World& world);
    double turned(const Velocity<double>& a, const Velocity<double>& b) const;
    void move_limit(double turned);
    /// What a flat piece still lacks.
    double missing(bool balance) const { return answer_.impulse - (balance ? 0 : impulse_); }

    std::uint32_t first_, last_;
    double h_ = 0;
    int looks_ = 0;  ///< in this substep
    AxisDrive drive_;
    DriveRow rows_[AxisDrive::kMostRows];  ///< of which that is made
    int limit_ = -1;                       ///< the limit's, where the axis turns
    const Joint* joint_ = nullptr;
    std::uint32_t axis_ = 0;
    JointPose pose_;  ///< at the start
    JointCoordinate q_;
    double bare_ = 0;      ///< K of the two bodies while the joint holds; 0 where nothing can move
    double response_ = 0;  ///< K with all that hangs on them, as far as it is known
    double start_ = 0;     ///< rate where the next step begins
    double rate_ = 0, impulse_ = 0, impulse_before_ = 0;  ///< where the last one ended
    double off_ = 0;                                      ///< as evaluate says [m], [rad]
    AxisAnswer answer_, next_;  ///< of the last Newton step; where it ended
};

}  // namespace plumb
