// SPDX-License-Identifier: MIT
#include "constraints/velocity_between.h"
#include "step/stages.h"
#include "world/motion_script.h"

namespace plumb {

void move_scripted(World& world, double h) {
    Bodies& b = world.bodies;
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] != Motion::kinematic || b.script[i].keyframes.empty()) continue;
        const Velocity<double> velocity = velocity_between(
            {b.position[i], b.orientation[i]}, placement_at(b.script[i], world.time + h), h);
        b.velocity[i] = velocity.v, b.angular_velocity[i] = velocity.w;
    }
}

void hold_scripted(Bodies& b) {
    for (std::size_t i = 0; i < b.size(); ++i)
        if (b.motion[i] == Motion::kinematic)
            b.velocity[i] = b.angular_velocity[i] = Vector3d::Zero();
}

}  // namespace plumb
