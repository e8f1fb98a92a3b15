// SPDX-License-Identifier: MIT
#include "step/stages.h"

namespace plumb {

void remember_velocities(Bodies& b) {
    b.velocity_before.swap(b.velocity_now);
    b.angular_velocity_before.swap(b.angular_velocity_now);
    b.velocity_now = b.velocity;
    b.angular_velocity_now = b.angular_velocity;
}

}  // namespace plumb
