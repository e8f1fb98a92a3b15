// SPDX-License-Identifier: MIT
#include "trees/tree_holder.h"

namespace plumb {

TreeHolder::TreeHolder(const World& world, std::uint32_t index) {
    const Joint& joint = world.joints.joints[index];
    for (const std::uint32_t body : {joint.a, joint.b})
        if (body != kNoIndex && world.bodies.motion[body] == Motion::kinematic) body_ = body;
    point_ = (body_ == joint.a ? joint.frame_a : joint.frame_b).position;
}

void TreeHolder::begin(const World& world, const Plan& plan, double h) {
    if (body_ == kNoIndex) return;
    path_ = HolderPath(world, plan, body_, h);
    hold_ = {};
    const Bodies& b = world.bodies;
    start_ = {b.position[body_], b.orientation[body_]};
    velocity_ = {b.velocity[body_], b.angular_velocity[body_]};
    now_ = {b.velocity_now[body_], b.angular_velocity_now[body_]};
    before_ = {b.velocity_before[body_], b.angular_velocity_before[body_]};
}

void TreeHolder::place(Bodies& b, double from, double to, double before) {
    const Placement here = path_.at(from);
    const Velocity<double> next = path_.velocity(from, to),
                           last = path_.velocity(from - before, from);
    b.position[body_] = here.position, b.orientation[body_] = here.rotation;
    b.velocity[body_] = next.v, b.angular_velocity[body_] = next.w;
    b.velocity_now[body_] = last.v, b.angular_velocity_now[body_] = last.w;
    // as if it went on getting faster at one rate, so that lines see no lag besides
    b.velocity_before[body_] = 2 * last.v - next.v;
    b.angular_velocity_before[body_] = 2 * last.w - next.w;

    const auto point_at = [this](double time) -> Vector3d {
        const Placement x = path_.at(time);
        return x.position + x.rotation * point_;
    };
    hold_.point = here.position + here.rotation * point_;
    const Vector3d way = point_at(to) - hold_.point,
                   way_before = hold_.point - point_at(from - before);
    const Vector3d v = way / (to - from), v_before = way_before / before;
    hold_.velocity = 0.5 * (v + v_before);
    hold_.rate = 0.5 * (next.w + last.w);
    hold_.acceleration = (v - v_before) / (0.5 * (to - from + before));
}

void TreeHolder::take_back(Bodies& b) const {
    b.position[body_] = start_.position, b.orientation[body_] = start_.rotation;
    b.velocity[body_] = velocity_.v, b.angular_velocity[body_] = velocity_.w;
    b.velocity_now[body_] = now_.v, b.angular_velocity_now[body_] = now_.w;
    b.velocity_before[body_] = before_.v, b.angular_velocity_before[body_] = before_.w;
}

}  // namespace plumb
