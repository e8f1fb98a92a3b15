// SPDX-License-Identifier: MIT
#include "step/stages.h"

namespace plumb {

void remember_velocities(Bodies& b) {
    b.velocity_before.swap(b.velocity_now);
    b.angular_velocity_before.swap(b.angular_velocity_now);
    b.velocity_now = b.velocity;
    b.angular_velocity_now = b.angular_velocity;
}

void remember_velocities(Bodies& b, const std::vector<std::uint32_t>& bodies) {
    for (const std::uint32_t i : bodies) {
        b.velocity_before[i] = b.velocity_now[i];
        b.angular_velocity_before[i] = b.angular_velocity_now[i];
        b.velocity_now[i] = b.velocity[i];
        b.angular_velocity_now[i] = b.angular_velocity[i];
    }
}

}  // namespace plumb
