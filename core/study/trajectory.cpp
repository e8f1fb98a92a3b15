// SPDX-License-Identifier: MIT
#include "study/trajectory.h"

#include "measure/measure.h"

#include <algorithm>
#include <cmath>

namespace plumb::study {

Moment moment_of(const World& world) {
    Moment m;
    const Vector3d& g = world.settings.gravity;
    const Vector3d up = g.norm() > 0 ? Vector3d(-g.normalized()) : Vector3d(Vector3d::UnitY());
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
        if (world.bodies.motion[i] != Motion::dynamic) continue;
        m.positions.push_back(world.bodies.position[i]);
        m.height += up.dot(world.bodies.position[i]);
    }
    m.height /= std::max<double>(1, static_cast<double>(m.positions.size()));
    m.kinetic_energy = kinetic_energy(world);
    m.energy = m.kinetic_energy + potential_energy(world);
    return m;
}

std::size_t Trajectory::index_at(double time) const {
    const double index = std::round(time / interval);
    if (std::abs(time - index * interval) > 1e-6 * interval) return kNone;
    return index < static_cast<double>(moments.size()) ? static_cast<std::size_t>(index) : kNone;
}

double largest_distance(const Moment& a, const Moment& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        largest = std::max(largest, (a.positions[i] - b.positions[i]).norm());
    return largest;
}

}  // namespace plumb::study
