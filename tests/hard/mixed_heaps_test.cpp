// SPDX-License-Identifier: MIT
/// Heaps of bodies of very different masses that fall on each other, at settings drawn at random:
/// what is heavy comes down on what is light, and is not thrown back by it.
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

class MixedHeaps : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, MixedHeaps, every_collider(), where_name);

Geometry draw_shape(Random& random, double size, bool plain) {
    const double a = size * random.number(0.2, 0.5), b = size * random.number(0.2, 0.5);
    switch (random.below(plain ? 2 : 4)) {
        case 0:
            return box(a, b, size * random.number(0.1, 0.5));
        case 1:
            return sphere(a);
        case 2:
            return capsule(0.6 * a, 0.6 * b);
        default:
            return cylinder(a, b);
    }
}

/// Falls freely, or into a bin; densities up to 1000 times each other's.
void add_heap(Scene& s, Random& random, bool plain) {
    const double size = std::exp(random.number(std::log(0.05), 0));
    s.materials[0].friction = random.number(0, 1);
    add_ground(s);
    if (random.below(2))
        for (const double side : {-2.25, 2.25}) {
            add_body(s, box(0.25 * size, 4 * size, 5 * size), {side * size, 4 * size, 0},
                     Motion::fixed);
            add_body(s, box(5 * size, 4 * size, 0.25 * size), {0, 4 * size, side * size},
                     Motion::fixed);
        }
    const double spread = std::pow(10, random.number(1, 3));
    const std::uint32_t count = 8 + random.below(12);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Geometry shape = draw_shape(random, size, plain);
        BodySpec& body = add_body(
            s, shape, size * Vector(random.number(-1, 1), 1 + 1.2 * i, random.number(-1, 1)));
        body.placement.rotation = random.rotation();
        Material material = s.materials[0];
        material.name = "material " + std::to_string(i);
        material.density = 1000 * std::pow(spread, random.number(0, 1));
        body.material = static_cast<std::uint32_t>(s.materials.size());
        s.materials.push_back(material);
    }
}

void draw_settings(Settings& s, Random& random) {
    const std::uint32_t which = random.below(3);
    if (which == 0) return;
    if (which == 1) return use_fine_steps(s);
    s.dt = random.number(0.001, 0.02);
    s.substeps = 1 + random.below(random.below(2) ? 40 : 4);
    s.velocity_iterations = s.position_iterations = 1 + random.below(50);
}

TEST_P(MixedHeaps, GainNoMoreThanOverlapIsPushedOutWith) {
    for (const unsigned seed : {0u, 1u, 2u, 3u, 29u, 64u, 78u, 97u, 110u}) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        Scene s = scene();
        add_heap(s, random, collider() == "reference");
        draw_settings(s.settings, random);
        Simulation simulation(s, colliders(), collider());
        const World& world = simulation.world();
        double mass = 0;
        for (const double m : world.bodies.mass) mass += m;
        const double pushed = 0.5 * mass * std::pow(s.settings.recovery_speed, 2);
        const double start = total_energy(simulation);
        double least = start, climbed = 0;
        while (simulation.time() < 4) {
            ASSERT_TRUE(simulation.step().finite);
            const double energy = total_energy(simulation);
            least = std::min(least, energy);
            climbed = std::max(climbed, energy - least);
        }
        EXPECT_LT(climbed, pushed + 1e-3 * start);
    }
}

}  // namespace
}  // namespace plumb::test
