// SPDX-License-Identifier: MIT
/// Restitution: heights of a bouncing ball, and bodies at rest that do not bounce.
#include "support/scenes.h"

#include <algorithm>
#include <vector>

namespace plumb::test {
namespace {

class Bounce : public OnEveryCollider {
protected:
    /// Clear heights of the ball's successive apexes after a drop from `height` [m].
    std::vector<double> apexes(double e, double height, bool fine, double seconds) {
        Scene s = scene();
        if (fine) use_fine_steps(s.settings);
        s.materials[0].restitution = e;
        add_ground(s);
        add_body(s, sphere(0.1), {0, 0.1 + height, 0});
        Simulation simulation(s, colliders(), collider());
        std::vector<double> tops;
        double top = 0, before = 0;
        const auto steps = std::llround(seconds / s.settings.dt);
        for (long long i = 0; i < steps; ++i) {
            simulation.step();
            const double v = simulation.world().bodies.velocity[1].y();
            const double y = simulation.world().bodies.position[1].y() - 0.1;
            if (v > 0 && before <= 0) top = 0;
            top = std::max(top, y);
            if (v < 0 && before >= 0 && i > 1 && top < 0.99 * height) tops.push_back(top);
            before = v;
        }
        return tops;
    }
};
INSTANTIATE_TEST_SUITE_P(, Bounce, every_collider(), where_name);

TEST_P(Bounce, HeightIsESquaredAtSixtyHertzAndTwentySubsteps) {
    for (double e : {0.4, 0.5, 0.75, 0.9}) {
        const std::vector<double> tops = apexes(e, 1, true, 4);
        ASSERT_GE(tops.size(), 2u);
        EXPECT_NEAR(tops[0] / (e * e), 1, 0.03) << "e " << e;
        EXPECT_NEAR(tops[1] / (e * e * tops[0]), 1, 0.05) << "second bounce, e " << e;
    }
}

TEST_P(Bounce, NeverComesTooHighAtTheCoarseStep) {
    for (double e : {0.25, 0.5, 0.75, 0.9})
        for (double height : {0.5, 0.77, 1.0, 1.31, 2.0}) {
            const std::vector<double> tops = apexes(e, height, false, 2.5);
            ASSERT_FALSE(tops.empty());
            EXPECT_LE(tops[0], 1.03 * e * e * height) << "e " << e << ", from " << height;
        }
}

TEST_P(Bounce, WhatRestsDoesNotBounce) {
    for (bool fine : {false, true}) {
        Scene s = scene();
        if (fine) use_fine_steps(s.settings);
        s.materials[0].restitution = 0.8;
        add_ground(s);
        add_body(s, box(0.3, 0.2, 0.4), {0, 0.2, 0});
        add_body(s, sphere(0.3), {2, 0.3, 0});
        Simulation simulation(s, colliders(), collider());
        const auto steps = std::llround(5 / s.settings.dt);
        for (long long i = 0; i < steps; ++i) {
            simulation.step();
            ASSERT_NEAR(simulation.world().bodies.position[1].y(), 0.2, 1e-4) << "step " << i;
            ASSERT_NEAR(simulation.world().bodies.position[2].y(), 0.3, 1e-4) << "step " << i;
        }
    }
}

}  // namespace
}  // namespace plumb::test
