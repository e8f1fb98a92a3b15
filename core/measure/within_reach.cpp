// SPDX-License-Identifier: MIT
#include "measure/within_reach.h"

namespace plumb {

bool within_reach(const World& world, double far) {
    const Bodies& b = world.bodies;
    for (std::size_t i = 0; i < b.size(); ++i)
        if (!(b.position[i].cwiseAbs().maxCoeff() < far) ||
            !(b.velocity[i].cwiseAbs().maxCoeff() < far) ||
            !(b.angular_velocity[i].cwiseAbs().maxCoeff() < far))
            return false;
    const Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (!(p.position[i].cwiseAbs().maxCoeff() < far) ||
            !(p.velocity[i].cwiseAbs().maxCoeff() < far))
            return false;
    return true;
}

}  // namespace plumb
