// SPDX-License-Identifier: MIT
#include "measure/within_reach.h"

namespace plumb {

bool within_reach(const World& world) {
    constexpr double kFar = 1e30;  // [m], [m/s], [rad/s]
    const Bodies& b = world.bodies;
    for (std::size_t i = 0; i < b.size(); ++i)
        if (!(b.position[i].cwiseAbs().maxCoeff() < kFar) ||
            !(b.velocity[i].cwiseAbs().maxCoeff() < kFar) ||
            !(b.angular_velocity[i].cwiseAbs().maxCoeff() < kFar))
            return false;
    const Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (!(p.position[i].cwiseAbs().maxCoeff() < kFar) ||
            !(p.velocity[i].cwiseAbs().maxCoeff() < kFar))
            return false;
    return true;
}

}  // namespace plumb
