// SPDX-License-Identifier: MIT
/// Boxes, balls, capsules, cylinders and cones dropped into a bin come to rest, at settings of one
/// to twenty substeps: wedges that friction locks, rims, cones on their slopes.
#include "support/random.h"
#include "support/scenes.h"

namespace plumb::test {
namespace {

constexpr double kSettled = 14, kEnd = 16;  // [s]

class MixedBins : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, MixedBins, every_collider(), where_name);

struct Stepping {
    double dt;  // [s]
    std::uint32_t substeps, iterations;
};
constexpr Stepping kSteppings[] = {{0.01, 1, 5},   {0.002, 1, 9},   {0.0126, 2, 11},
                                   {0.0033, 3, 5}, {0.0067, 12, 3}, {0.0167, 20, 1}};

Geometry draw_shape(Random& random, double size, std::uint32_t shapes) {
    const double r = size * random.number(0.2, 0.5), h = size * random.number(0.2, 0.5);
    switch (random.below(shapes)) {
        case 0:
            return box(r, h, r);
        case 1:
            return sphere(r);
        case 2:
            return capsule(0.6 * r, 0.6 * h);
        case 3:
            return cylinder(r, h);
        default:
            return cone(r, h);
    }
}

/// Up to thirty, one after another, into a bin as wide as four of the largest.
Scene bin_of_all_shapes(Scene s, Random& random, std::uint32_t shapes) {
    const double size = random.number(0.2, 1);  // of the largest [m]
    Material& surface = s.materials[0];
    surface.friction = random.number(0.4, 0.9);
    // what rolls on its rim at v stops after some v r/(g ρ), by the end of this test
    surface.rolling_friction = surface.spinning_friction = 0.01 * size;
    add_ground(s);
    for (const double side : {-2.25, 2.25}) {
        add_body(s, box(0.25 * size, 4 * size, 5 * size), {side * size, 4 * size, 0},
                 Motion::fixed);
        add_body(s, box(5 * size, 4 * size, 0.25 * size), {0, 4 * size, side * size},
                 Motion::fixed);
    }
    const std::uint32_t count = 10 + random.below(20);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector at(random.number(-1, 1), 1 + 0.9 * i, random.number(-1, 1));
        add_body(s, draw_shape(random, size, shapes), size * at).placement.rotation =
            random.rotation();
    }
    return s;
}

TEST_P(MixedBins, ComeToRest) {
    if (collider() == "reference") GTEST_SKIP() << "no cylinders and cones on all shapes";
    const std::uint32_t shapes = collider() == "ode" ? 4 : 5;  // ODE has no cones
    unsigned seed = 0;
    for (const Stepping& stepping : kSteppings) {
        Random random(++seed);
        Scene s = bin_of_all_shapes(scene(), random, shapes);
        s.settings.dt = stepping.dt, s.settings.substeps = stepping.substeps;
        s.settings.velocity_iterations = s.settings.position_iterations = stepping.iterations;
        SCOPED_TRACE(seed);
        Simulation simulation(s, colliders(), collider());
        expect_still(motions_between(simulation, kSettled, kEnd));
    }
}

}  // namespace
}  // namespace plumb::test
