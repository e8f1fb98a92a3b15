// SPDX-License-Identifier: MIT
#include "study/trajectory.h"

#include "measure/deformation.h"
#include "measure/measure.h"
#include "world/sleep.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumb::study {
namespace {

/// Root of the mean square of the particles' ways, weighted by mass.
double distance(const Cloud& a, const Cloud& b) {
    double sum = 0, mass = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
        sum += a.masses[i] * (a.positions[i] - b.positions[i]).squaredNorm();
        mass += a.masses[i];
    }
    return std::sqrt(sum / mass);
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) /
           std::max(1.0, static_cast<double>(values.size()));
}

/// Calls visit(body) for each that is dynamic.
template <class Visit>
void each_dynamic(const Bodies& bodies, Visit visit) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (is_movable(bodies.motion[i])) visit(i);
}

}  // namespace

double energy(const World& world) { return kinetic_energy(world) + potential_energy(world); }

double mean_height(const World& world) {
    const Vector3d& g = world.settings.gravity;
    const Vector3d up = g.norm() > 0 ? Vector3d(-g.normalized()) : Vector3d(Vector3d::UnitY());
    std::vector<double> heights;
    each_dynamic(world.bodies,
                 [&](std::size_t i) { heights.push_back(up.dot(world.bodies.position[i])); });
    for (const Deformable& d : world.deformables) heights.push_back(up.dot(centre_of(world, d)));
    return mean(heights);
}

double mean_speed(const World& world) {
    double mass = std::accumulate(world.particles.mass.begin(), world.particles.mass.end(), 0.0);
    each_dynamic(world.bodies, [&](std::size_t i) { mass += world.bodies.mass[i]; });
    return mass > 0 ? linear_momentum(world).norm() / mass : 0;
}

double mean_strain(const World& world) { return mean(strains(world)); }

Moment moment_of(const World& world) {
    Moment m;
    each_dynamic(world.bodies,
                 [&](std::size_t i) { m.bodies.push_back(world.bodies.position[i]); });
    for (const Deformable& d : world.deformables) {
        const auto of_it = [&](const auto& column) {
            return std::vector(column.begin() + d.first, column.begin() + d.first + d.count);
        };
        m.deformables.push_back({of_it(world.particles.position), of_it(world.particles.mass)});
    }
    m.kinetic_energy = kinetic_energy(world);
    m.energy = energy(world);
    m.height = mean_height(world);
    m.speed = mean_speed(world);
    m.strain = mean_strain(world);
    return m;
}

std::size_t Trajectory::index_at(double time) const {
    const double index = std::round(time / interval);
    if (std::abs(time - index * interval) > 1e-6 * interval) return kNone;
    return index < static_cast<double>(moments.size()) ? static_cast<std::size_t>(index) : kNone;
}

std::vector<double> distances(const Moment& a, const Moment& b) {
    std::vector<double> all;
    for (std::size_t i = 0; i < a.bodies.size(); ++i)
        all.push_back((a.bodies[i] - b.bodies[i]).norm());
    for (std::size_t i = 0; i < a.deformables.size(); ++i)
        all.push_back(distance(a.deformables[i], b.deformables[i]));
    return all;
}

double largest_distance(const Moment& a, const Moment& b) {
    double most = 0;
    for (const double d : distances(a, b)) most = std::max(most, d);
    return most;
}

}  // namespace plumb::study
