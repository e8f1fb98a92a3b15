// SPDX-License-Identifier: MIT
/// Joints that form trees, each solved exactly by one worker.
#pragma once

#include "schedule/joint_forest.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "step/tree_solver.h"

#include <algorithm>
#include <deque>

namespace plumb {

template <class Real, int W>
class JointTreeGroup final : public ConstraintGroup<Real> {
public:
    JointTreeGroup(const World& world, const JointForest& forest, Workers& workers)
        : workers_(workers) {
        for (const JointForest& share : share_out_trees(forest, workers.count()))
            trees_.emplace_back(world, share);
    }

    Stage stage() const override { return Stage::trees; }
    bool empty() const override { return trees_.empty(); }

    void begin(const World& world, const BodyRows<Real>&, const PassSettings<Real>&,
               double h) override {
        workers_.run([&](std::uint32_t worker) {
            if (worker < trees_.size()) trees_[worker].begin(world, h);
        });
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        if (worker < trees_.size()) trees_[worker].solve(rows, pass.alone);
        workers_.barrier();
    }

    void end_substep(World& world) override {
        for (TreeSolver<W>& trees : trees_) trees.store_impulses(world.joints);
    }

    void report(StepReport& report) const override {
        for (const TreeSolver<W>& trees : trees_) {
            report.unsolved_trees += trees.unsolved().count;
            report.tree_error = std::max(report.tree_error, trees.unsolved().error);
        }
    }

private:
    Workers& workers_;
    std::deque<TreeSolver<W>> trees_;  ///< [worker], or fewer
};

}  // namespace plumb
