// SPDX-License-Identifier: MIT
#include "step/holder_path.h"

#include "math/rotation.h"
#include "world/motion_script.h"

namespace plumb {
namespace {

/// With which a script leads through the substep that begins at `from` [s].
Velocity<double> scripted_velocity(const MotionScript& script, double from, double h) {
    const Placement start = placement_at(script, from), end = placement_at(script, from + h);
    return {
        (end.position - start.position) / h,
        rotation_vector(end.rotation.normalized() * start.rotation.normalized().conjugate()) / h};
}

}  // namespace

HolderPath::HolderPath(const World& world, const Plan& plan, std::uint32_t body, double h)
    : h_(h), start_{world.bodies.position[body], world.bodies.orientation[body]} {
    const Bodies& b = world.bodies;
    const Velocity<double> now{b.velocity[body], b.angular_velocity[body]};
    const MotionScript& script = b.script[body];
    if (script.keyframes.empty() || !plan.runs(Effect::kinematics)) {
        const Vector3d &v = b.velocity_before[body], &w = b.angular_velocity_before[body];
        ways_ = {{v, v, v}, {now.v, now.v, now.v}};
        turns_ = {{w, w, w}, {now.w, now.w, now.w}};
    } else {
        // before the world began, it is taken to have come as it goes on
        const auto in_substep = [&](int k) {
            const double from = world.time + k * h;
            return from > -0.5 * h ? scripted_velocity(script, from, h) : now;
        };
        const Velocity<double> next = in_substep(1), last = in_substep(-1), first = in_substep(-2);
        const Vector3d v = 0.5 * (last.v + now.v), w = 0.5 * (last.w + now.w);
        ways_ = {{0.5 * (first.v + last.v), last.v, v}, {v, now.v, 0.5 * (now.v + next.v)}};
        turns_ = {{0.5 * (first.w + last.w), last.w, w}, {w, now.w, 0.5 * (now.w + next.w)}};
    }
    moves_ = !(ways_.are_still() && turns_.are_still());
}

Placement HolderPath::at(double time) const {
    const double s = time / h_;
    return {start_.position + h_ * ways_.at(s), turned(start_.rotation, h_ * turns_.at(s))};
}

Velocity<double> HolderPath::velocity(double from, double to) const {
    const double s = from / h_, t = to / h_, per_second = 1 / (t - s);
    const Quaterniond turn = at(to).rotation * at(from).rotation.conjugate();
    return {per_second * (ways_.at(t) - ways_.at(s)), rotation_vector(turn) / (to - from)};
}

}  // namespace plumb
