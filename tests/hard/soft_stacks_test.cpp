// SPDX-License-Identifier: MIT
/// Stacks of stiff soft cubes, solved as one system: none gains energy where it lands on another,
/// and all come to rest.
#include "support/draw_settings.h"
#include "support/soft.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class SoftStacks : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, SoftStacks, each_precision(), precision_name);

/// Two to four cubes of up to 100 MPa fall on one another from a few centimetres, with or without a
/// plate on top.
TEST_P(SoftStacks, StiffCubesComeToRest) {
    Random random(61);
    for (int draw = 0; draw < 12; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.exact_deformables = 10000;
        draw_settings(s.settings, random, draw);
        add_ground(s);
        const int cubes = 2 + int(random.below(3));
        double most = 0;
        for (int i = 0; i < cubes; ++i) {
            const std::uint32_t cells = 1 + random.below(3);
            const Eigen::Vector3d at(random.number(-0.01, 0.01), 0.22 + 0.44 * i,
                                     random.number(-0.01, 0.01));
            DeformableSpec& cube = add_soft(s, block({0.2, 0.2, 0.2}, {cells, cells, cells}, at));
            cube.mass = 14, cube.radius = 0.01;
            cube.elasticity.youngs_modulus = std::pow(10, random.number(6, 8));
            cube.elasticity.poissons_ratio = random.number(0, 0.49);
            cube.elasticity.damping = 0.02;
            most = std::max(most, cube.elasticity.youngs_modulus);
        }
        const bool has_plate = draw % 2 == 1;
        if (has_plate) add_body(s, box(0.2, 0.05, 0.2), {0, 0.44 * cubes + 0.1, 0}).mass = 50;
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        const double fall = std::sqrt(2 * 9.81 * 0.1 * cubes);
        double ever = 0, at_end = 0;
        while (simulation.time() < 3) {
            ASSERT_TRUE(simulation.step().finite);
            at_end = has_plate ? world.bodies.velocity[1].norm() : 0;
            for (const Vector3d& v : world.particles.velocity) at_end = std::max(at_end, v.norm());
            ever = std::max(ever, at_end);
        }
        std::cout << cubes << " cubes of up to " << most << " Pa: fastest " << ever << " m/s, "
                  << at_end << " m/s at the end\n";
        EXPECT_LT(ever, 3 * fall);
        EXPECT_LT(at_end, 5e-3);
    }
}

}  // namespace
}  // namespace plumb::test
