// SPDX-License-Identifier: MIT
/// How far joints and couplings are from what they hold, whatever solved them, and which of them
/// gape so that anyone would see it.
#pragma once

#include "effects/report.h"
#include "ties/joint_state.h"
#include "world/world.h"

#include <algorithm>
#include <cstdint>

namespace plumb {

/// How far a joint's points are apart [m], and its bodies are turned against each other [rad],
/// where the joint does not let them.
struct JointError {
    double along = 0, about = 0;
};

/// Of what a joint locks; 0 of what gives way (compliance).
JointError locked_error(const Joint& joint, const JointPose& pose);

/// By how much a limit is passed; 0 of other drives.
JointError limit_error(const World& world, const JointDrive& drive, const JointPose& pose);

/// Visits each joint that is whole with its error, that of its limits included:
/// visit(index, error). `closed`: it is known that joints keep what they lock.
template <class Visit>
void each_joint_error(const World& world, bool closed, Visit visit) {
    const JointTable& table = world.joints;
    auto drive = table.drives.begin();
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        const auto first = drive;
        while (drive != table.drives.end() && drive->joint == i) ++drive;
        const Joint& joint = table.joints[i];
        if (joint.broken || (closed && drive == first)) continue;
        const JointPose pose = joint_pose(world.bodies, joint);
        JointError error = closed ? JointError() : locked_error(joint, pose);
        for (auto limit = first; limit != drive; ++limit) {
            const JointError passed = limit_error(world, *limit, pose);
            error = {std::max(error.along, passed.along), std::max(error.about, passed.about)};
        }
        visit(i, error);
    }
}

/// By how much q_b misses ratio q_a + offset [m], [rad]; 0 where one of the joints is broken.
double coupling_error(const World& world, const JointCoupling& coupling);

/// From how far on a joint gapes: 1 mm, or 1 % of the size of its smaller body if that is less; and
/// 0.01 rad.
JointError gaping_from(const Bodies& bodies, const Joint& joint);

/// From which error on one of a coupling's joints is off by as much, as long as the other is not.
double gaping_from(const World& world, const JointCoupling& coupling);

/// Tells the report of the joints and couplings that gape. `closed`: as above.
void note_gaping_joints(const World& world, bool closed, StepReport& report);

}  // namespace plumb
