// SPDX-License-Identifier: MIT
/// Kinematic jaws that close a little further than a body is wide, lift it and stand: nothing rigid
/// can do that, but no energy comes of it while they stand.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

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

/// Two plates that close in free space until there is no room for a body between them that friction
/// keeps from turning flat, and open again.
TEST_P(Clamps, FlingNothingOutThatTheyJam) {
    constexpr double kThick = 0.2, kSpeed = 0.03;
    Random random(52);
    for (int draw = 0; draw < 12; ++draw) {
        Scene s = scene();
        s.settings.gravity.setZero();
        s.materials[0].friction = random.number(0.3, 1);
        draw_settings(s.settings, random, draw);
        const Vector half(random.number(0.05, 0.2), random.number(0.05, 0.2), 0.2);
        BodySpec& body = add_body(s, box(half.x(), half.y(), half.z()), Vector::Zero());
        body.placement.rotation = random.rotation();
        const double open = half.norm() + 0.01, closed = 0.6 * std::min(half.x(), half.y());
        const double time = (open - closed) / kSpeed;
        for (const double side : {1.0, -1.0}) {
            BodySpec& plate = add_body(s, box(kThick, 2, 2), {side * (open + kThick), 0, 0});
            plate.motion = Motion::kinematic;
            for (const auto& [at, x] : {std::pair(0.0, open), {time, closed}, {2 * time, open}}) {
                Keyframe k;
                k.time = at, k.placement.position = {side * (x + kThick), 0, 0};
                plate.script.keyframes.push_back(k);
            }
        }
        Simulation simulation(s, colliders(), collider());
        double fastest = 0;
        while (simulation.time() < 2 * time) {
            simulation.step();
            fastest = std::max(fastest, simulation.world().bodies.velocity[0].norm());
        }
        EXPECT_LT(fastest, 2 * s.settings.recovery_speed)
            << "draw " << draw << ", " << s.settings.dt << " s x " << s.settings.substeps << " x "
            << s.settings.position_iterations << ", half extents " << half.transpose();
    }
}

}  // namespace
}  // namespace plumb::test
