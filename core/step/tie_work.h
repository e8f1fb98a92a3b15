// SPDX-License-Identifier: MIT
#pragma once

#include "step/driven_axes.h"
#include "world/tie.h"

namespace plumb {

/// Whether a tie may give its bodies energy: motors, springs and what is compliant do.
inline bool can_do_work(const World& world, const Tie& tie) {
    if (tie.kind == TieKind::coupling) return false;
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
