// SPDX-License-Identifier: MIT
/// Kinematic bodies follow keyframes; between two of them position is linear and rotation turns
/// evenly.
#include "math/rotation.h"
#include "step/stages.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

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

}  // namespace

void move_scripted(World& world, double h) {
    Bodies& b = world.bodies;
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] != Motion::kinematic || b.script[i].keyframes.empty()) continue;
        const Placement target = placement_at(b.script[i], world.time + h);
        b.velocity[i] = (target.position - b.position[i]) / h;
        b.angular_velocity[i] =
            rotation_vector(target.rotation.normalized() * b.orientation[i].conjugate()) / h;
    }
}

void hold_scripted(Bodies& b) {
    for (std::size_t i = 0; i < b.size(); ++i)
        if (b.motion[i] == Motion::kinematic)
            b.velocity[i] = b.angular_velocity[i] = Vector3d::Zero();
}

}  // namespace plumb
