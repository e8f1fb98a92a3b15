// SPDX-License-Identifier: MIT
#include "trees/holder_path.h"

#include "constraints/velocity_between.h"
#include "world/motion_script.h"

#include <algorithm>

namespace plumb {
namespace {

/// With which a script leads through the substep that begins at `from` [s].
Velocity<double> velocity_through(const MotionScript& script, double from, double h) {
    Placement start = placement_at(script, from);
    start.rotation.normalize();
    return velocity_between(start, placement_at(script, from + h), h);
}

/// Velocities of the substeps from two before one that meets the next, to two after that.
struct Meeting {
    Vector3d earlier, before, after, later;

    /// Whether it jumps from the one to the other: the changes beside are not of its kind.
    bool jumps() const {
        const Vector3d change = after - before;
        const double beside = std::max(change.dot(before - earlier), change.dot(later - after));
        return beside < 0.25 * change.squaredNorm();
    }
    Vector3d end_before() const { return jumps() ? before : Vector3d(0.5 * (before + after)); }
    Vector3d start_after() const { return jumps() ? after : Vector3d(0.5 * (before + after)); }
};

}  // namespace

HolderPath::Ways HolderPath::ways_of(const std::array<Vector3d, 6>& v) {
    const Meeting first{v[0], v[1], v[2], v[3]}, start{v[1], v[2], v[3], v[4]},
        end{v[2], v[3], v[4], v[5]};
    return {{first.start_after(), v[2], start.end_before()},
            {start.start_after(), v[3], end.end_before()}};
}

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
            return from > -0.5 * h ? velocity_through(script, from, h) : now;
        };
        std::array<Vector3d, 6> v, w;
        for (int k = -3; k <= 2; ++k) {
            const Velocity<double> of = k == 0 ? now : in_substep(k);
            v[static_cast<std::size_t>(k + 3)] = of.v, w[static_cast<std::size_t>(k + 3)] = of.w;
        }
        ways_ = ways_of(v), turns_ = ways_of(w);
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
