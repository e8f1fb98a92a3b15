// SPDX-License-Identifier: MIT
/// Shock propagation (§6): stacks of 1 m cubes, h = 0.01 s, 10 substeps × (1 + 1) iterations, 10 s.
#include "support/scenes.h"

#include <algorithm>
#include <iostream>

namespace plumb::test {
namespace {

struct Stack {
    int cubes = 20;
    double top_ratio = 1;  ///< mass of the topmost over that of the others
    double friction = 0.5;
    double offset = 0;  ///< each cube sits this far to the side of the one below, in turn [m]
};

struct Outcome {
    double top_moved = 0, deepest = 0;  ///< [m]
};

class Stacks : public OnEveryCollider {
protected:
    Outcome stand(const Stack& stack) {
        Scene s = scene();
        s.settings.substeps = 10;
        s.settings.velocity_iterations = s.settings.position_iterations = 1;
        s.settings.require = {"shock_propagation"};
        s.materials[0].friction = stack.friction;
        add_ground(s);
        for (int i = 0; i < stack.cubes; ++i) {
            BodySpec& cube =
                add_body(s, box(0.5, 0.5, 0.5), {i % 2 ? stack.offset : 0, 0.5 + i, 0});
            if (i == stack.cubes - 1) cube.mass = 1000 * stack.top_ratio;
        }
        Simulation simulation(s, colliders(), collider());
        const Vector start = simulation.world().bodies.position.back();
        Outcome outcome;
        for (int i = 0; i < 1000; ++i) {
            simulation.step();
            outcome.top_moved = std::max(
                outcome.top_moved, (simulation.world().bodies.position.back() - start).norm());
            for (double depth : penetrations(simulation.world()))
                outcome.deepest = std::max(outcome.deepest, depth);
        }
        std::cout << stack.cubes << " cubes, top " << stack.top_ratio << " times, friction "
                  << stack.friction << ", offset " << stack.offset * 1e3 << " mm: top moved "
                  << outcome.top_moved * 1e3 << " mm, penetration " << outcome.deepest * 1e3
                  << " mm\n";
        return outcome;
    }
    void expect_stands(const Stack& stack) {
        const Outcome o = stand(stack);
        EXPECT_LT(o.top_moved, 0.5e-3);
        EXPECT_LT(o.deepest, 1e-7);
    }
};
INSTANTIATE_TEST_SUITE_P(, Stacks, every_collider(), where_name);

TEST_P(Stacks, TwentyStand) { expect_stands({}); }
TEST_P(Stacks, TwentyStandUnderATopAThousandTimesHeavier) { expect_stands({20, 1000, 0.5, 0}); }
TEST_P(Stacks, StandWithOtherFrictionsHeightsAndMasses) {
    expect_stands({20, 1, 0.3, 0});
    expect_stands({20, 1000, 0.8, 0});
    expect_stands({12, 100, 0.5, 0});
}
TEST_P(Stacks, StandWhenLaidUnevenly) {
    expect_stands({20, 1, 0.5, 0.001});
    expect_stands({20, 1000, 0.5, 0.01});
}

}  // namespace
}  // namespace plumb::test
