// SPDX-License-Identifier: MIT
/// What drives a joint, axis by axis.
#pragma once

#include "world/joints.h"

#include <algorithm>
#include <cstdint>

namespace plumb {

/// Calls visit(first, last) for each axis of a joint that something drives, with its range of
/// JointTable::drives, which stand by joint, then axis.
template <class Visit>
void each_driven_axis(const JointTable& table, std::uint32_t joint, Visit visit) {
    const auto& drives = table.drives;
    const auto before = [](const JointDrive& d, std::uint32_t i) { return d.joint < i; };
    const auto found = std::lower_bound(drives.begin(), drives.end(), joint, before);
    auto at = static_cast<std::uint32_t>(found - drives.begin());
    while (at < drives.size() && drives[at].joint == joint) {
        const std::uint32_t first = at;
        while (at < drives.size() && drives[at].joint == joint &&
               drives[at].axis == drives[first].axis)
            ++at;
        visit(first, at);
    }
}

}  // namespace plumb
