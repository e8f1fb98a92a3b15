// SPDX-License-Identifier: MIT
/// Kinematic jaws that close a little further than a body is wide, lift it and stand: nothing rigid
/// can do that, but no energy comes of it while they stand.
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>

namespace plumb::test {
namespace {

class Clamps : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Clamps, every_collider(), where_name);

constexpr double kHalf = 0.3;              // of the body's width [m]
constexpr double kLifted = 1.5, kEnd = 4;  // [s]
constexpr double kRisen = 0.1;             // that the energy gained would lift the body [m]

/// A jaw that closes by 20 mm and `squeeze`, then rises by half a metre.
void add_jaw(Scene& s, double side, double thickness, double squeeze) {
    const double open = kHalf + 0.12, closed = kHalf + 0.1 - squeeze;
    BodySpec& jaw = add_body(s, box(0.1, thickness, kHalf), {side * open, thickness, 0});
    jaw.motion = Motion::kinematic;
    const auto at = [&](double time, double x, double y) {
        Keyframe k;
        k.time = time, k.placement.position = {side * x, y, 0};
        jaw.script.keyframes.push_back(k);
    };
    at(0, open, thickness), at(0.5, closed, thickness), at(kLifted, closed, thickness + 0.5);
}

TEST_P(Clamps, AddNothingWhileTheyStand) {
    Random random(51);
    for (int draw = 0; draw < 12; ++draw) {
        Scene s = scene();
        s.materials[0].friction = 0.8;
        if (draw % 3 == 1) use_fine_steps(s.settings);
        if (draw % 3 == 2) s.settings.dt = 0.002;
        add_ground(s);
        const double thickness = random.number(0.02, 0.2), squeeze = random.number(0.0003, 0.002);
        for (const int side : {-1, 1}) add_jaw(s, side, thickness, squeeze);
        const bool is_disk = draw % 2 == 1 && collider() != "reference";
        add_body(s, is_disk ? cylinder(kHalf, thickness) : box(kHalf, thickness, 0.2),
                 {0, thickness, 0});
        Simulation simulation(s, colliders(), collider());
        const World& world = simulation.world();
        run_for(simulation, kLifted + 0.1);
        const double before = total_energy(simulation);
        double most = before;
        while (simulation.time() < kEnd) {
            simulation.step();
            most = std::max(most, total_energy(simulation));
        }
        const double height = (most - before) / (9.81 * world.bodies.mass.back());
        EXPECT_LT(height, kRisen) << "draw " << draw << (is_disk ? ", disk of " : ", box of ")
                                  << thickness << " m, squeezed by " << squeeze << " m, "
                                  << s.settings.dt << " s x " << s.settings.substeps;
    }
}

}  // namespace
}  // namespace plumb::test
