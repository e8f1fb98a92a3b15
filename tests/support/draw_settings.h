// SPDX-License-Identifier: MIT
/// Settings of a draw: the usual ones, fine steps, and others at random.
#pragma once

#include "support/random.h"
#include "support/scenes.h"

namespace plumb::test {

inline void draw_settings(Settings& s, Random& random, int draw) {
    if (draw % 3 == 0) return;
    if (draw % 3 == 1) return use_fine_steps(s);
    s.dt = random.number(0.001, 0.01);
    s.substeps = 1 + random.below(12);
    s.velocity_iterations = s.position_iterations = 1 + random.below(10);
}

}  // namespace plumb::test
