// SPDX-License-Identifier: MIT
#include "step/fast_joints.h"

#include "math/free_rotation.h"
#include "schedule/joint_trees.h"
#include "ties/joint_state.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Whether it may have turned too far: its rate at the end is known, not that of its way there.
bool may_turn_far(const Vector3d& rate, double h) {
    constexpr double kMost = 2;  // times the rate at the end
    return turns_too_far<double>(rate, kMost * h) > 0;
}
bool may_turn_far(const Bodies& b, std::uint32_t body, double h) {
    return body != kNoIndex && may_turn_far(b.angular_velocity[body], h);
}

/// The same of the fastest body, which is quickly seen.
bool may_any_turn_far(const Bodies& b, double h) {
    double most = 0;
    for (const Vector3d& rate : b.angular_velocity) most = std::max(most, rate.squaredNorm());
    return may_turn_far(Vector3d(std::sqrt(most), 0, 0), h);
}

}  // namespace

FastJoints::FastJoints(const World& world, const Plan& plan) {
    if (!plan.runs(Effect::joint_trees) || !plan.runs(Effect::gyroscopic)) return;
    const JointForest forest = find_forest(world);
    std::vector<std::size_t> tree;     // [node]
    std::vector<std::uint32_t> first;  // [tree] its first joint
    for (const ForestNode& node : forest.nodes) {
        tree.push_back(node.parent < 0 ? first.size() : tree[node.parent]);
        first.resize(std::max(first.size(), tree.back() + 1), kNoIndex);
        if (node.parent == kFree) continue;
        if (first[tree.back()] == kNoIndex) first[tree.back()] = node.joint;
        joints_.push_back({node.joint, first[tree.back()]});
    }
}

void FastJoints::note_open(const World& world, double h, StepReport& report) const {
    const Bodies& b = world.bodies;
    if (joints_.empty() || !may_any_turn_far(b, h)) return;
    for (const Item& item : joints_) {
        const Joint& joint = world.joints.joints[item.joint];
        if (!may_turn_far(b, joint.a, h) && !may_turn_far(b, joint.b, h)) continue;
        const double error = std::max(joint_gap(b, joint), joint_turn_gap(b, joint));
        if (error > world.settings.joint_tolerance)
            note_open_tree(report.open_trees, {item.first, error});
    }
}

}  // namespace plumb
