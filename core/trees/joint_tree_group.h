// SPDX-License-Identifier: MIT
/// Joints that form trees, each solved exactly by one worker.
#pragma once

#include "schedule/joint_forest.h"
#include "schedule/workers.h"
#include "solve/constraint_group.h"
#include "solve/joint_residual.h"
#include "trees/tree_solver.h"

#include <algorithm>
#include <deque>
#include <vector>

namespace plumb {

template <class Real, int W>
class JointTreeGroup final : public ConstraintGroup<Real> {
public:
    /// `in_island` [joint]: in this step, whether an exact island has it.
    JointTreeGroup(const World& world, const JointForest& forest,
                   const std::vector<std::uint8_t>& in_island, Workers& workers)
        : in_island_(in_island), workers_(workers) {
        for (const JointForest& share : share_out_trees(forest, workers.count()))
            trees_.emplace_back(world, share, world.settings.joint_tolerance);
        for (std::uint32_t i = 0; i < forest.in_tree.size(); ++i)
            if (forest.in_tree[i]) joints_.push_back(i);
    }

    Stage stage() const override { return Stage::trees; }
    bool empty() const override { return trees_.empty(); }

    void begin(const World& world, const BodyRows<Real>&, const PassSettings<Real>&,
               double h) override {
        workers_.run([&](std::uint32_t worker) {
            if (worker >= trees_.size()) return;
            if (leave_to_others(world, trees_[worker])) trees_[worker].load_impulses(world.joints);
            trees_[worker].begin(world, substep_time(world, h));
        });
    }

    void iterate_positions(const BodyRows<Real>& rows, const PassSettings<Real>& pass,
                           std::uint32_t worker) override {
        if (worker < trees_.size()) trees_[worker].solve(rows, pass.alone);
        workers_.barrier();
    }

    /// Only where others touch them: alone they are exact.
    void add_residuals(IslandResiduals& islands, const World& world, const BodyRows<Real>&,
                       const PassSettings<Real>&) override {
        for (const std::uint32_t i : joints_) {
            const Joint& joint = world.joints.joints[i];
            if (in_island_[i] || joint.broken || joint.pace.is_divided()) continue;
            islands.add(world.row_of(joint.a), world.row_of(joint.b),
                        open_residual(world, joint, substep_of(world.settings)));
        }
    }

    void end_substep(World& world) override {
        for (TreeSolver<W>& trees : trees_) {
            leave_to_others(world, trees);  // with those that had to be divided after all
            trees.store_impulses(world.joints);
        }
    }

    void report(StepReport& report) const override {
        for (const TreeSolver<W>& trees : trees_)
            report.open_trees.insert(report.open_trees.end(), trees.open().begin(),
                                     trees.open().end());
        for (const TreeSolver<W>& trees : trees_) report.coarse_trees += trees.braked();
    }

private:
    bool leave_to_others(const World& world, TreeSolver<W>& trees) const {
        return trees.leave_out([&](std::uint32_t joint) {
            return in_island_[joint] || world.joints.joints[joint].pace.is_divided();
        });
    }

    const std::vector<std::uint8_t>& in_island_;
    Workers& workers_;
    std::vector<std::uint32_t> joints_;  ///< of all trees
    std::deque<TreeSolver<W>> trees_;    ///< [worker], or fewer
};

}  // namespace plumb
