// SPDX-License-Identifier: MIT
/// What swings, meets nothing, and is to keep its energy.
#pragma once

#include "support/scenes.h"

#include <cstdint>

namespace plumb::test {

inline Scene still_scene(Precision precision) {
    Scene s;
    s.settings.precision = precision;
    s.settings.forbid = {"contacts"};
    return s;
}

/// Of what hangs in a line from the origin, at rest below it [J].
inline double lowest_energy(const Scene& s) {
    Simulation simulation(s, colliders(), "reference");
    double sum = 0;
    for (std::size_t i = 0; i < simulation.world().bodies.size(); ++i)
        sum -=
            simulation.world().bodies.mass[i] * 9.81 * simulation.world().bodies.position[i].norm();
    return sum;
}

/// Mean energy above the lowest in the last tenth of `seconds` against that in the first.
/// `coarse`: how often the steps told that a tree was faster than its parts.
inline double energy_left(const Scene& s, double lowest, std::uint32_t* coarse = nullptr,
                          double seconds = 60) {
    Simulation simulation(s, colliders(), "reference");
    double first = 0, last = 0;
    int of_first = 0, of_last = 0;
    while (simulation.time() < seconds) {
        const StepReport report = simulation.step();
        if (coarse) *coarse += report.coarse_trees;
        const double energy = total_energy(simulation) - lowest;
        if (simulation.time() < 0.1 * seconds) first += energy, ++of_first;
        if (simulation.time() > 0.9 * seconds) last += energy, ++of_last;
    }
    return (last / of_last) / (first / of_first);
}

}  // namespace plumb::test
