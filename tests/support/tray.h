// SPDX-License-Identifier: MIT
/// Sheets that are held at their rims, for things to lie on.
#pragma once

#include "support/random.h"
#include "support/scenes.h"
#include "support/soft.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb::test {

struct Tray {
    Scene scene;
    double size;                 ///< of a side [m]
    double cloth = 0, load = 0;  ///< masses of it and of what lies on it [kg]
    bool is_round = false;       ///< a ball, which rolls
};

/// A sheet held at its rim, of from 5 to 13 cells, with nothing on it.
inline Tray empty_tray(Scene empty, Random& random) {
    Tray t{std::move(empty), random.number(0.5, 2.5)};
    Scene& s = t.scene;
    s.settings.exact_deformables = 1000;
    const std::uint32_t cells = 5 + random.below(9), n = cells + 1;
    DeformableSpec cloth = sheet({cells, cells}, {t.size, t.size});
    cloth.mass = random.number(0.1, 2);
    cloth.elasticity.youngs_modulus = std::pow(10, random.number(6, 11));
    cloth.elasticity.damping = random.number(0.02, 0.05);
    t.cloth = cloth.mass.value();
    add_soft(s, std::move(cloth));
    std::vector<std::uint32_t> rim;
    for (std::uint32_t i = 0; i < n * n; ++i)
        if (i % n == 0 || i % n == cells || i < n || i >= cells * n) rim.push_back(i);
    hold(s, 0, rim);
    return t;
}

/// No energy is gained on the way.
inline void run_until(Simulation& simulation, double time) {
    const double before = total_energy(simulation);
    double most = before;
    while (simulation.time() < time) {
        ASSERT_TRUE(simulation.step().finite);
        most = std::max(most, total_energy(simulation));
    }
    EXPECT_LT(most, before + 1e-3 * std::abs(before));
}

}  // namespace plumb::test
