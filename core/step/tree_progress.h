// SPDX-License-Identifier: MIT
/// Which trees of a forest are still to be solved. Each ends its Newton steps for itself, so that
/// no tree feels another, and rests while others go on.
#pragma once

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
        violation_.assign(trees, 0), before_ = first_ = violation_;
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
        return std::find(active_.begin(), active_.end(), 1) != active_.end();
    }
    /// What the trees were off before any step.
    void remember_start() { first_ = violation_; }
    void look_again() {
        std::swap(violation_, before_);
        std::fill(violation_.begin(), violation_.end(), 0.0);
    }

    /// How far a node is off [m], [rad]; what is not a number is far off.
    void note(std::uint32_t node, double violation) {
        double& worst = violation_[tree_[node]];
        constexpr double far_off = std::numeric_limits<double>::infinity();
        worst = std::max(worst, std::isnan(violation) ? far_off : violation);
    }

    /// Returns whether any tree is left.
    bool leave_those_within(double tolerance) {
        bool left = false;
        for (std::size_t i = 0; i < active_.size(); ++i) {
            active_[i] = active_[i] && violation_[i] > tolerance;
            left |= active_[i] != 0;
        }
        return left;
    }

    /// Before a step: finds the trees that it brings well within the tolerance, if it shrinks what
    /// they are off as the last one did; Newton steps do better than that. What driven trees and
    /// those that are far off come to is to be seen.
    void find_last_steps(double tolerance) {
        for (std::size_t i = 0; i < active_.size(); ++i)
            ends_[i] = active_[i] && !driven_[i] && violation_[i] <= kNear * tolerance &&
                       violation_[i] * violation_[i] < 0.1 * tolerance * before_[i];
    }
    /// After it: returns whether any other is left.
    bool leave_those_that_end() {
        bool left = false;
        for (std::size_t i = 0; i < active_.size(); ++i) {
            active_[i] = active_[i] && !ends_[i];
            left |= active_[i] != 0;
        }
        return left;
    }

    /// Calls visit(joint, how far off [m], [rad]) for each tree that is still to be solved, with
    /// its first joint.
    template <class Visit>
    void each_open(Visit visit) const {
        for (std::size_t i = 0; i < active_.size(); ++i)
            if (active_[i]) visit(joint_[i], violation_[i]);
    }

    /// Leaves those that are no worse off than before any step; the same return.
    bool leave_those_no_worse() {
        bool left = false;
        for (std::size_t i = 0; i < active_.size(); ++i) {
            active_[i] = active_[i] && violation_[i] > first_[i];
            left |= active_[i] != 0;
        }
        return left;
    }

private:
    static constexpr double kNear = 20;

    std::vector<std::uint32_t> tree_;                 ///< [node]
    std::vector<std::uint32_t> joint_;                ///< [tree] its first
    std::vector<std::uint8_t> active_, hung_;         ///< [tree]
    std::vector<std::uint8_t> left_out_, driven_;     ///< [tree]
    std::vector<std::uint8_t> ends_;                  ///< [tree] with the present step
    std::vector<double> violation_, before_, first_;  ///< [tree]
};

}  // namespace plumb
