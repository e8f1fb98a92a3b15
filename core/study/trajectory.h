// SPDX-License-Identifier: MIT
/// A run as it is remembered to compare others with: where its bodies were at evenly spaced times.
#pragma once

#include "world/world.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace plumb::study {

/// One moment of a run.
struct Moment {
    std::vector<Vector3d> positions;  ///< [dynamic body], centres of mass [m]
    double kinetic_energy = 0;        ///< [J]
    double energy = 0;                ///< kinetic, and potential of gravity [J]
    double height = 0;                ///< mean of the dynamic bodies, against gravity [m]
};
Moment moment_of(const World& world);

/// Moments at 0, interval, 2 × interval, …
struct Trajectory {
    double interval = 0;  ///< [s]
    std::vector<Moment> moments;

    /// Which of them a world shows; none where its time lies between two, or beyond the last.
    static constexpr std::size_t kNone = ~std::size_t{0};
    std::size_t index_at(double time) const;
};

/// Largest distance between the same bodies at two moments [m].
double largest_distance(const Moment& a, const Moment& b);

}  // namespace plumb::study
