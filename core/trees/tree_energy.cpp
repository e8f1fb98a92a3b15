// SPDX-License-Identifier: MIT
#include "trees/tree_energy.h"

#include "world/body_momentum.h"

#include <algorithm>
#include <cmath>

namespace plumb {

double turning_work(const World& world, const std::vector<std::uint32_t>& bodies,
                    const std::vector<Vector3d>& pushed, const TreeHold& hold) {
    if (hold.rate.isZero(0)) return 0;
    const Bodies& b = world.bodies;
    double work = 0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const std::uint32_t i = bodies[k];
        const Vector3d impulse = b.mass[i] * (b.velocity[i] - pushed[k]);
        work += hold.rate.dot((b.position[i] - hold.point).cross(impulse)) +
                inertia_product(b, i, hold.rate, b.turn_change[i]);
    }
    return work;
}

double energy_defect(const World& world, const std::vector<std::uint32_t>& bodies,
                     const SubstepTime& time, double fall, double unclosed, const TreeHold& hold,
                     double work) {
    const Bodies& b = world.bodies;
    const Vector3d& g = world.settings.gravity;
    const double weight = (g - hold.acceleration).norm();
    double defect = 0, moving = 0, known = 0;
    for (const std::uint32_t i : bodies) {
        const Vector3d v = b.velocity[i] - hold.velocity, v0 = b.velocity_now[i] - hold.velocity;
        const Vector3d &w = b.angular_velocity[i], &w0 = b.angular_velocity_now[i];
        const double now = kinetic_energy(b, i, v, w), then = kinetic_energy(b, i, v0, w0);
        const Vector3d push = fall * b.mass[i] * g + time.push() * b.force[i];
        const Vector3d twist = time.push() * b.torque[i];
        defect += now - then - 0.5 * (push.dot(v + v0) + twist.dot(w + w0));
        moving += now + then;
        known += b.mass[i] * weight * (weight * fall * fall + unclosed);
    }
    if (!(moving + known > 0)) return 0;
    const double unknown = std::max(0.0, std::abs(defect - work) - known);
    return std::copysign(unknown, defect - work) / (moving + known);
}

}  // namespace plumb
