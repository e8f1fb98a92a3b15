// SPDX-License-Identifier: MIT
#pragma once

#include "step/driven_axes.h"
#include "world/tie.h"

namespace plumb {

/// Whether something limits a joint's axes.
inline bool has_limits(const World& world, std::uint32_t joint) {
    bool has = false;
    each_driven_axis(world.joints, joint, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i)
            has |= world.joints.drives[i].kind == DriveKind::limit;
    });
    return has;
}

/// Whether a tie may give its bodies energy: motors, springs and what is compliant do, and a
/// coupling that comes to a far offset, or that limits may keep from where it belongs.
inline bool can_do_work(const World& world, const Tie& tie) {
    if (tie.kind == TieKind::coupling) {
        const JointCoupling& c = world.joints.couplings[tie.index];
        return c.deferred != 0 || has_limits(world, c.joint_a) || has_limits(world, c.joint_b);
    }
    if (tie.kind == TieKind::link) return world.links[tie.index].compliance > 0;
    const Joint& joint = world.joints.joints[tie.index];
    bool can = joint.compliance > 0 || joint.angular_compliance > 0;
    each_driven_axis(world.joints, tie.index, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            const DriveKind kind = world.joints.drives[i].kind;
            can |= kind == DriveKind::motor || kind == DriveKind::spring;
        }
    });
    return can;
}

}  // namespace plumb
