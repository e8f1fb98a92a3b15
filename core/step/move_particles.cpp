// SPDX-License-Identifier: MIT
/// Symplectic Euler of particles (§3): forces before the passes, the move after them.
#include "constraints/substep_time.h"
#include "step/stages.h"

namespace plumb {

void integrate_particles(World& world, double h) {
    Particles& p = world.particles;
    const Vector3d push = substep_time(world, h).push() * world.settings.gravity;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p.inverse_mass[i] > 0) p.velocity[i] += push;
}

void move_particles(World& world, double h) {
    Particles& p = world.particles;
    for (std::size_t i = 0; i < p.size(); ++i) p.position[i] += h * p.velocity[i];
}

}  // namespace plumb
