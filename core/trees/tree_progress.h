// SPDX-License-Identifier: MIT
/// Which trees of a forest are still to be solved. Each ends its Newton steps for itself, so that
/// no tree feels another, and rests while others go on.
#pragma once

#include "math/types.h"
#include "scene/joint.h"
#include "schedule/joint_forest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plumb {

class TreeProgress {
public:
    /// `driven`: [joint] whether anything drives it.
    TreeProgress(const JointForest& forest, const std::vector<std::uint8_t>& driven) {
        std::uint32_t trees = 0;
        for (const ForestNode& node : forest.nodes) {
            tree_.push_back(node.parent < 0 ? trees++ : tree_[node.parent]);
            if (node.parent < 0) hung_.push_back(node.parent == kHeld);
            joint_.resize(trees, kNoIndex), driven_.resize(trees, 0);
            if (node.parent != kFree && driven[node.joint]) driven_.back() = 1;
            std::uint32_t& first = joint_[tree_.back()];
            if (node.parent != kFree && first == kNoIndex) first = node.joint;
        }
        active_.assign(trees, 1), left_out_.assign(trees, 0), ends_.assign(trees, 0);
        open_.assign(trees, 0);
        waits_.assign(trees, Waits::no), pieces_.resize(trees);
        any_driven_ = std::find(driven_.begin(), driven_.end(), 1) != driven_.end();
        violation_.assign(trees, 0), before_ = first_ = violation_;
        falls_.resize(trees);
    }

    std::size_t trees() const { return active_.size(); }
    /// Whether the root of a node's tree hangs by something.
    bool hangs(std::uint32_t node) const { return hung_[tree_[node]] != 0; }
    bool is_active(std::uint32_t node) const { return active_[tree_[node]] != 0; }

    /// Those that are advanced by themselves in this substep; `is_left_out(joint)`. Returns whether
    /// any is back that was left out before.
    template <class IsLeftOut>
    bool leave_out(IsLeftOut is_left_out) {
        bool back = false;
        for (std::size_t i = 0; i < joint_.size(); ++i) {
            const bool before = left_out_[i] != 0;
            left_out_[i] = is_left_out(joint_[i]);
            back |= before && !left_out_[i];
        }
        return back;
    }
    bool leaves_any_out() const {
        return std::find(left_out_.begin(), left_out_.end(), 1) != left_out_.end();
    }
    bool leaves_all_out() const {
        return std::find(left_out_.begin(), left_out_.end(), 0) == left_out_.end();
    }
    bool is_left_out(std::uint32_t node) const { return left_out_[tree_[node]] != 0; }

    /// Returns whether any tree is to be solved.
    bool start() {
        for (std::size_t i = 0; i < active_.size(); ++i) active_[i] = !left_out_[i];
        std::fill(violation_.begin(), violation_.end(), 0.0);
        return any_active();
    }
    /// What the trees were off before any step.
    void remember_start() { first_ = violation_; }
    void look_again() {
        std::swap(violation_, before_);
        std::fill(violation_.begin(), violation_.end(), 0.0);
    }

    bool any_driven() const { return any_driven_; }

    /// Before a Newton step, of which nothing has been tried.
    void begin_step() {
        for (Pieces& pieces : pieces_) pieces = {};
    }
    /// How many axes of a node are on a wrong piece of what drives them.
    void note_wrong_pieces(std::uint32_t node, std::uint32_t count) {
        pieces_[tree_[node]].wrong += count;
    }
    /// Lets trees wait that have none, and those that were tried often enough, which are stuck.
    /// Returns whether any other is left. Of those may change: all axes that are wrong, as long as
    /// that leaves fewer and fewer of them, else the first alone until it does, which goes round in
    /// no circle (Júdice and Pires, Computers and Operations Research 21, 1994; Murty's rule).
    bool leave_settled() {
        for (std::size_t i = 0; i < active_.size(); ++i) {
            if (!active_[i]) continue;
            Pieces& pieces = pieces_[i];
            if (pieces.wrong == 0 || ++pieces.tries > kMostTries) {
                active_[i] = 0, waits_[i] = pieces.wrong == 0 ? Waits::settled : Waits::stuck;
                continue;
            }
            if (pieces.wrong < pieces.fewest)
                pieces.fewest = pieces.wrong, pieces.patience = kPatience;
            else if (pieces.patience > 0)
                --pieces.patience;
            pieces.may_change = pieces.patience > 0 ? pieces.wrong : 1;
            pieces.wrong = 0;
        }
        return any_active();
    }
    std::uint32_t changes_left(std::uint32_t node) const { return pieces_[tree_[node]].may_change; }
    void count_changes(std::uint32_t node, std::uint32_t changed) {
        pieces_[tree_[node]].may_change -= changed;
    }

    /// Makes those that are settled active again, or all that wait. Returns whether any is to be
    /// solved.
    bool bring_back(bool all) {
        for (std::size_t i = 0; i < active_.size(); ++i)
            if (waits_[i] == Waits::settled || (all && waits_[i] != Waits::no))
                active_[i] = 1, waits_[i] = Waits::no;
        return any_active();
    }

    /// How far a node is off [m], [rad]; what is not a number is far off.
    void note(std::uint32_t node, double violation) {
        double& worst = violation_[tree_[node]];
        constexpr double far_off = std::numeric_limits<double>::infinity();
        worst = std::max(worst, std::isnan(violation) ? far_off : violation);
    }

    /// Once: the mass of a body [kg].
    void note_mass(std::uint32_t node, double mass) {
        Falls& falls = falls_[tree_[node]];
        falls.heaviest = std::max(falls.heaviest, mass);
        falls.mass += mass;
    }
    bool any_loaded() const {
        for (std::size_t i = 0; i < falls_.size(); ++i)
            if (is_loaded(i)) return true;
        return false;
    }

    /// Before any step: the mass of a body [kg], and the height from which it would fall to its
    /// speed [m]. That of the tree is the mean by mass: a light rod that trembles counts for
    /// little. Speeds are against what the tree hangs by; `velocity_of(joint)`: of the holder of
    /// the tree that begins with it [m/s]; `h`: length of the substep, or of the part of it [s].
    template <class VelocityOf>
    void forget_falls(double h, VelocityOf velocity_of) {
        open_of_fall_ = std::min(kOpenOfFall, kOpenOfFallASecond * h);
        for (std::size_t i = 0; i < falls_.size(); ++i)
            falls_[i].moment = 0, falls_[i].holder = velocity_of(joint_[i]);
    }
    const Vector3d& holder_velocity(std::uint32_t node) const { return falls_[tree_[node]].holder; }
    void note_fall(std::uint32_t node, double mass, double height) {
        falls_[tree_[node]].moment += mass * height;
    }

    /// Returns whether any tree is left.
    bool leave_those_within(double tolerance) {
        return leave([&](std::size_t i) { return !(violation_[i] > tolerance); });
    }
    /// The same; loaded ones go on until they are open by little against their fall.
    bool leave_those_closed(double tolerance) {
        return leave([&](std::size_t i) { return !(violation_[i] > fine(i, tolerance)); });
    }
    /// But for those that something drives.
    bool leave_undriven_within(double tolerance) {
        return leave([&](std::size_t i) { return !driven_[i] && !(violation_[i] > tolerance); });
    }

    /// Before a step: finds the trees that it brings well within the tolerance, if it shrinks what
    /// they are off as the last one did; Newton steps do better than that. What driven trees and
    /// those that are far off come to is to be seen.
    void find_last_steps(double tolerance) {
        for (std::size_t i = 0; i < active_.size(); ++i)
            ends_[i] = active_[i] && !driven_[i] && violation_[i] <= kNear * fine(i, tolerance) &&
                       violation_[i] * violation_[i] < 0.1 * fine(i, tolerance) * before_[i];
    }
    /// After it: returns whether any other is left.
    bool leave_those_that_end() {
        return leave([&](std::size_t i) { return ends_[i] != 0; });
    }

    /// Calls visit(joint, how far off [m], [rad]) for each tree that is still to be solved, with
    /// its first joint.
    template <class Visit>
    void each_open(Visit visit) const {
        for (std::size_t i = 0; i < active_.size(); ++i)
            if (active_[i]) visit(joint_[i], violation_[i]);
    }

    /// A tree is to be solved again, from elsewhere.
    void begin_anew(std::size_t tree) { active_[tree] = 1, violation_[tree] = 0; }
    /// Calls solve(tree, its first joint, whether it hangs by something) for each tree that is
    /// still to be solved, as if there were no other. Leaves those for which it returns true;
    /// returns whether any is left.
    template <class Solve>
    bool leave_one_by_one(Solve solve) {
        open_ = active_;
        for (std::size_t i = 0; i < open_.size(); ++i) {
            if (!open_[i]) continue;
            std::fill(active_.begin(), active_.end(), 0);
            active_[i] = 1;
            open_[i] = !solve(i, joint_[i], hung_[i] != 0);
        }
        active_ = open_;
        return any_active();
    }

    /// Leaves those that are no worse off than before any step, which are visited as above; the
    /// same return.
    template <class Visit>
    bool leave_those_no_worse(Visit visit) {
        return leave([&](std::size_t i) {
            if (violation_[i] > first_[i]) return false;
            visit(joint_[i], violation_[i]);
            return true;
        });
    }

private:
    static constexpr double kNear = 20;
    /// By which share of its fall a loaded tree may be open, one of whose bodies is heavier than
    /// all others together. What Newton's last step leaves of a joint's error has always the same
    /// sign: a load that goes down with it in each substep feeds or brakes what swings.
    /// Of parts there may be thousands in what is one substep of others.
    static constexpr double kOpenOfFall = 1e-5, kOpenOfFallASecond = 1e-3;  // −, [1/s]
    /// Tries that all axes at once have to leave fewer wrong, and how often a step is tried.
    static constexpr int kPatience = 4, kMostTries = 60;

    enum class Waits : std::uint8_t { no, settled, stuck };

    /// How the search for the pieces on which a tree's axes are goes on.
    struct Pieces {
        std::uint32_t wrong = 0, may_change = 0;
        std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
        int patience = 0, tries = 0;
    };

    bool any_active() const {
        return std::find(active_.begin(), active_.end(), 1) != active_.end();
    }

    struct Falls {
        Vector3d holder = Vector3d::Zero();  ///< velocity [m/s]
        double heaviest = 0, mass = 0;       ///< [kg]
        double moment = 0;                   ///< Σ m × height [kg m]
    };

    bool is_loaded(std::size_t tree) const {
        return !driven_[tree] && 2 * falls_[tree].heaviest > falls_[tree].mass;
    }
    double fine(std::size_t tree, double tolerance) const {
        if (!is_loaded(tree)) return tolerance;
        return std::min(tolerance, open_of_fall_ * falls_[tree].moment / falls_[tree].mass);
    }

    template <class IsDone>
    bool leave(IsDone is_done) {
        bool left = false;
        for (std::size_t i = 0; i < active_.size(); ++i) {
            active_[i] = active_[i] && !is_done(i);
            left |= active_[i] != 0;
        }
        return left;
    }

    std::vector<std::uint32_t> tree_;              ///< [node]
    std::vector<std::uint32_t> joint_;             ///< [tree] its first
    std::vector<std::uint8_t> active_, hung_;      ///< [tree]
    std::vector<std::uint8_t> left_out_, driven_;  ///< [tree]
    std::vector<std::uint8_t> ends_;               ///< [tree] with the present step
    std::vector<std::uint8_t> open_;               ///< [tree] of those solved one by one
    std::vector<Waits> waits_;                     ///< [tree]
    bool any_driven_ = false;
    std::vector<Pieces> pieces_;                      ///< [tree]
    std::vector<double> violation_, before_, first_;  ///< [tree]
    std::vector<Falls> falls_;                        ///< [tree]
    double open_of_fall_ = kOpenOfFall;               ///< in this substep
};

}  // namespace plumb
