// SPDX-License-Identifier: MIT
#include "math/rotation.h"
#include "step/stages.h"
#include "world/motion_script.h"

namespace plumb {

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
