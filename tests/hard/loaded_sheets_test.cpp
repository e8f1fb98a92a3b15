// SPDX-License-Identifier: MIT
/// Bodies on sheets, contacts and what holds the sheet together solved as one: it dents, and all
/// comes to rest.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/soft.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

namespace plumb::test {
namespace {

class LoadedSheets : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, LoadedSheets, every_collider(), where_name);

struct Tray {
    Scene scene;
    double size;      ///< of a side [m]
    double load = 0;  ///< that lies on it [kg]
    double slow = 0;  ///< at rest nothing is faster [m/s]
};

/// A sheet held at its rim, of from 5 to 13 cells, and what falls on it: from a tenth of its mass
/// to twenty times it.
Tray tray(Scene empty, Random& random) {
    Tray t{std::move(empty), random.number(0.5, 2.5)};
    Scene& s = t.scene;
    s.settings.exact_deformables = 1000;
    const std::uint32_t cells = 5 + random.below(9), n = cells + 1;
    DeformableSpec cloth = sheet({cells, cells}, {t.size, t.size});
    cloth.mass = random.number(0.1, 2);
    cloth.elasticity.youngs_modulus = std::pow(10, random.number(6, 8));
    cloth.elasticity.damping = random.number(0.02, 0.05);
    const double mass = cloth.mass.value();
    add_soft(s, std::move(cloth));
    std::vector<std::uint32_t> rim;
    for (std::uint32_t i = 0; i < n * n; ++i)
        if (i % n == 0 || i % n == cells || i < n || i >= cells * n) rim.push_back(i);
    hold(s, 0, rim);
    const double radius = t.size * random.number(0.05, 0.2);
    const bool is_round = random.below(2) == 0;
    // a ball rolls to and fro for long, so it falls into the middle
    const double aside = is_round ? 0 : random.number(-0.1, 0.1) * t.size;
    BodySpec& body =
        add_body(s, is_round ? sphere(radius) : box(radius, 0.6 * radius, 0.8 * radius),
                 {aside, 1.5 * radius, -aside / 2});
    t.slow = is_round ? 0.02 : 0.005;
    body.mass = t.load = mass * std::pow(10, random.number(-1, 1.3));
    s.materials[0].friction = random.number(0.2, 0.9);
    return t;
}

TEST_P(LoadedSheets, ComeToRestWithWhatLiesOnThem) {
    // each draws scenes of its own
    Random random(static_cast<std::uint32_t>(31 * collider().size() + collider()[0] +
                                             (GetParam() == Where(collider(), Precision::single))));
    for (int draw = 0; draw < 6; ++draw) {
        Tray t = tray(scene(), random);
        if (draw % 3 == 1) use_fine_steps(t.scene.settings);
        if (draw % 3 == 2) draw_steps(t.scene.settings, random, {0.002, 0.02, 6, 1, 8});
        Simulation simulation(t.scene, colliders(), collider());
        const World& world = simulation.world();
        run_for(simulation, 5);
        double body = 0, point = 0;
        while (simulation.time() < 6) {
            simulation.step();
            body = std::max(body, fastest_point(world));
            for (const Vector& v : world.particles.velocity) point = std::max(point, v.norm());
        }
        std::cout << draw << ": " << t.load << " kg, body " << body << " m/s, points " << point
                  << " m/s at " << world.bodies.position[0].transpose() << "\n";
        EXPECT_LT(body, t.slow);
        EXPECT_LT(point, t.slow);
        EXPECT_LT(world.bodies.position[0].y(), t.size);
        EXPECT_GT(world.bodies.position[0].y(), -t.size / 2) << "it has fallen through";
    }
}

}  // namespace
}  // namespace plumb::test
