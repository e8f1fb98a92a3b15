// SPDX-License-Identifier: MIT
/// A run as it is remembered to compare others with: where its bodies and deformables were at
/// evenly spaced times.
///
/// A deformable counts as one thing, like a body: its distance between two moments is the root of
/// the mean square of its particles' distances, weighted by mass. So a finer mesh weighs no more
/// than a coarse one, and neither drowns a body.
#pragma once

#include "world/world.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace plumb::study {

/// Particles of one deformable.
struct Cloud {
    std::vector<Vector3d> positions;  ///< [m]
    std::vector<double> masses;       ///< [kg]
};

/// One moment of a run.
struct Moment {
    std::vector<Vector3d> bodies;  ///< [dynamic body], centres of mass [m]
    std::vector<Cloud> deformables;
    double kinetic_energy = 0;                             ///< [J]
    double energy = 0, height = 0, speed = 0, strain = 0;  ///< as the functions below tell
};
Moment moment_of(const World& world);

double energy(const World& world);       ///< kinetic, and potential of gravity [J]
double mean_height(const World& world);  ///< of dynamic bodies' and deformables' centres [m]
double mean_speed(const World& world);   ///< size of the momentum over all mass that moves [m/s]
double mean_strain(const World& world);  ///< of the deformables (measure/deformation.h)

/// Moments at 0, interval, 2 × interval, …
struct Trajectory {
    double interval = 0;  ///< [s]
    std::vector<Moment> moments;

    /// Which of them a world shows; none where its time lies between two, or beyond the last.
    static constexpr std::size_t kNone = ~std::size_t{0};
    std::size_t index_at(double time) const;
};

/// Distances between the same things at two moments [m]: dynamic bodies, then deformables.
std::vector<double> distances(const Moment& a, const Moment& b);
double largest_distance(const Moment& a, const Moment& b);  ///< [m]

}  // namespace plumb::study
