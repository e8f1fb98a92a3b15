// SPDX-License-Identifier: MIT
#include "step/stages.h"
#include "ties/joint_state.h"
#include "world/edit_world.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

bool is_overloaded(const World& world, std::uint32_t index) {
    const Joint& joint = world.joints.joints[index];
    const JointLoad load = joint_load(world, index);
    return load.force.norm() > joint.breaking_force || load.torque.norm() > joint.breaking_torque;
}

/// Lets the collider test the bodies of a joint again, unless something else keeps them apart.
Status let_meet(const World& world, const Joint& joint, Proximity& proximity) {
    const Bodies& b = world.bodies;
    const std::uint64_t pair = kept_apart(joint);
    if (b.geometry[joint.a] == kNoIndex || b.geometry[joint.b] == kNoIndex ||
        std::count(world.excluded.begin(), world.excluded.end(), pair) > 1)
        return ok_status();
    return proximity.exclude(std::min(joint.a, joint.b), std::max(joint.a, joint.b), false);
}

}  // namespace

std::vector<std::uint32_t> breakable_joints(const World& world) {
    std::vector<std::uint32_t> breakable;
    for (std::uint32_t i = 0; i < world.joints.size(); ++i) {
        const Joint& joint = world.joints.joints[i];
        if (std::isfinite(joint.breaking_force) || std::isfinite(joint.breaking_torque))
            breakable.push_back(i);
    }
    return breakable;
}

void break_joints(World& world, const std::vector<std::uint32_t>& breakable, const Plan& plan,
                  Proximity& proximity, StepReport& report) {
    for (const std::uint32_t i : breakable) {
        Joint& joint = world.joints.joints[i];
        if (joint.broken || !is_overloaded(world, i)) continue;
        joint.broken = true;
        ++report.broken_joints;
        if (!joint.keeps_apart) continue;
        const Status status =
            plan.runs(Effect::contacts) ? let_meet(world, joint, proximity) : ok_status();
        if (status.code == Status::ok) {
            stop_keeping_apart(world, joint);
            continue;
        }
        report.collider_failed = true;
        report.message = status.message ? status.message : "a pair was not let in again";
    }
}

}  // namespace plumb
