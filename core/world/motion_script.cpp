// SPDX-License-Identifier: MIT
#include "world/motion_script.h"

#include <algorithm>
#include <cmath>

namespace plumb {

Placement placement_at(const MotionScript& script, double time) {
    const auto& frames = script.keyframes;
    const double first = frames.front().time, span = frames.back().time - first;
    if (script.loop && span > 0 && time > first) time = first + std::fmod(time - first, span);
    const auto next = std::upper_bound(frames.begin(), frames.end(), time,
                                       [](double t, const Keyframe& k) { return t < k.time; });
    if (next == frames.begin()) return frames.front().placement;
    if (next == frames.end()) return frames.back().placement;
    const Keyframe& last = *(next - 1);
    const double share = (time - last.time) / (next->time - last.time);
    return {last.placement.position + share * (next->placement.position - last.placement.position),
            last.placement.rotation.slerp(share, next->placement.rotation)};
}

}  // namespace plumb
