// SPDX-License-Identifier: MIT
/// Settings of a draw: the usual ones, fine steps, and others at random.
#pragma once

#include "support/random.h"
#include "support/scenes.h"

namespace plumb::test {

/// Lengths of a step [s]; numbers of substeps, from one on, and of iterations, both ends among
/// them.
struct StepRange {
    double shortest, longest;
    std::uint32_t most_substeps, least_iterations, most_iterations;
};

inline void draw_steps(Settings& s, Random& random, const StepRange& range) {
    s.dt = random.number(range.shortest, range.longest);
    s.substeps = 1 + random.below(range.most_substeps);
    s.velocity_iterations = s.position_iterations =
        range.least_iterations + random.below(range.most_iterations - range.least_iterations + 1);
}

inline void draw_settings(Settings& s, Random& random, int draw) {
    if (draw % 3 == 0) return;
    if (draw % 3 == 1) return use_fine_steps(s);
    draw_steps(s, random, {0.001, 0.01, 12, 1, 10});
}

}  // namespace plumb::test
