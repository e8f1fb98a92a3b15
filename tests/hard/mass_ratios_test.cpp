// SPDX-License-Identifier: MIT
/// Heavy bodies on light ones of the same size stand where they were put, from the first step on.
#include "support/random.h"
#include "support/scenes.h"

#include <cmath>

namespace plumb::test {
namespace {

class MassRatios : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, MassRatios, every_collider(), where_name);

/// Cubes on each other; returns how far any has come from its place within a second, in edges.
double moved_of(Scene s, const std::string& collider, double edge,
                const std::vector<double>& masses) {
    add_ground(s);
    for (std::size_t i = 0; i < masses.size(); ++i)
        add_body(s, box(edge / 2, edge / 2, edge / 2), {0, edge * (0.5 + double(i)), 0}).mass =
            masses[i];
    Simulation simulation(s, colliders(), collider);
    const std::vector<Vector> start = simulation.world().bodies.position;
    run_for(simulation, 1);
    return farthest_from(start, simulation.world()) / edge;
}

TEST_P(MassRatios, HeavyOnLightStands) {
    Random random(3);
    for (int draw = 0; draw < 60; ++draw) {
        Scene s = scene();
        s.settings.dt = random.number(0.002, 0.02);
        s.settings.substeps = 1 + random.below(4);
        s.settings.velocity_iterations = s.settings.position_iterations = 3 + random.below(10);
        const double edge = 0.02 * std::pow(25, random.number(0, 1));
        const double ratio = std::pow(10, random.number(1, 5));
        std::vector<double> masses(2 + random.below(9), 1.0);
        if (draw % 3 == 0)
            masses.back() = ratio;  // the top alone
        else if (draw % 3 == 1)
            masses = {1, ratio};
        else
            for (std::size_t i = 1; i < masses.size(); i += 2) masses[i] = std::sqrt(ratio);
        EXPECT_LT(moved_of(s, collider(), edge, masses), 1e-4)
            << masses.size() << " cubes of " << edge << " m, 1 : " << ratio << ", " << s.settings.dt
            << " s x " << s.settings.substeps;
    }
}

}  // namespace
}  // namespace plumb::test
