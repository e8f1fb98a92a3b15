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
    double size;            ///< of a side [m]
    double load = 0;        ///< that lies on it [kg]
    bool is_round = false;  ///< a ball, which rolls
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
    cloth.elasticity.youngs_modulus = std::pow(10, random.number(6, 11));
    cloth.elasticity.damping = random.number(0.02, 0.05);
    const double mass = cloth.mass.value();
    add_soft(s, std::move(cloth));
    std::vector<std::uint32_t> rim;
    for (std::uint32_t i = 0; i < n * n; ++i)
        if (i % n == 0 || i % n == cells || i < n || i >= cells * n) rim.push_back(i);
    hold(s, 0, rim);
    const double radius = t.size * random.number(0.05, 0.2);
    t.is_round = random.below(2) == 0;
    // a ball rolls to and fro for long, so it falls into the middle
    const double aside = t.is_round ? 0 : random.number(-0.1, 0.1) * t.size;
    BodySpec& body =
        add_body(s, t.is_round ? sphere(radius) : box(radius, 0.6 * radius, 0.8 * radius),
                 {aside, 1.5 * radius, -aside / 2});
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
        const double before = total_energy(simulation);
        double most = before;
        while (simulation.time() < 5) {
            ASSERT_TRUE(simulation.step().finite);
            most = std::max(most, total_energy(simulation));
        }
        EXPECT_LT(most, before + 1e-3 * std::abs(before));
        double body = 0, point = 0;
        while (simulation.time() < 6) {
            simulation.step();
            // what rolls on for long does not bob up and down
            body = std::max(
                body, t.is_round ? std::abs(world.bodies.velocity[0].y()) : fastest_point(world));
            for (const Vector& v : world.particles.velocity) point = std::max(point, v.norm());
        }
        std::cout << draw << ": " << t.load << " kg, body " << body << " m/s, points " << point
                  << " m/s at " << world.bodies.position[0].transpose() << "\n";
        EXPECT_LT(body, 5e-3);
        EXPECT_LT(point, t.is_round ? 0.02 : 5e-3);
        EXPECT_LT(world.bodies.position[0].y(), t.size);
        EXPECT_GT(world.bodies.position[0].y(), -t.size / 2) << "it has fallen through";
    }
}

}  // namespace
}  // namespace plumb::test
