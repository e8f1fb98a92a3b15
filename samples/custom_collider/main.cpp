// SPDX-License-Identifier: MIT
/// A ball rolls to and fro in a bowl; prints the period of its swing, and the formula's.
///
/// A ball that rolls without slipping has 7/5 of its mass to move along, so with small swings
/// T = 2π √(7 (R − r) / (5 g)).
#include "bowl.h"
#include "host/simulation.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>

namespace {

constexpr double kBowl = 1.0, kBall = 0.1;  // radii [m]
constexpr double kTilt = 0.1;               // of the swing [rad]

plumb::Scene ball_in_bowl() {
    plumb::Scene scene;
    scene.settings.dt = 0.002;
    scene.settings.precision = plumb::Precision::double_;
    scene.geometries.resize(2);
    scene.geometries[0].kind = plumb::ShapeKind::plane;  // what the collider takes for the bowl
    scene.geometries[1].kind = plumb::ShapeKind::sphere;
    scene.geometries[1].radius = kBall;
    scene.bodies.resize(2);
    for (std::uint32_t i = 0; i < 2; ++i) scene.bodies[i].geometry = i;
    scene.bodies[0].motion = plumb::Motion::fixed;
    scene.bodies[1].placement.position = {(kBowl - kBall) * std::sin(kTilt),
                                          -(kBowl - kBall) * std::cos(kTilt), 0};
    return scene;
}

}  // namespace

int main() try {
    const plumb::Scene scene = ball_in_bowl();
    Bowl bowl(kBowl);
    plumb::Simulation simulation(scene, bowl, "bowl");

    // Times at which the ball passes the lowest point, between two steps.
    double first = 0, last = 0, before = 1;
    int passes = 0;
    plumb::Frame frame;
    while (simulation.time() < 20) {
        simulation.step();
        simulation.capture(frame);
        const double x = frame.bodies[1].placement.position.x();
        if (before * x < 0) {
            last = simulation.time() - scene.settings.dt * x / (x - before);
            if (passes++ == 0) first = last;
        }
        if (x != 0) before = x;
    }
    if (passes < 2) {
        std::fprintf(stderr, "the ball does not swing\n");
        return 1;
    }
    const double period = 2 * (last - first) / (passes - 1);
    const double formula = 2 * std::numbers::pi * std::sqrt(7 * (kBowl - kBall) / (5 * 9.81));
    std::printf("period %.4f s after %d passes, by the formula %.4f s\n", period, passes, formula);
    return std::abs(period / formula - 1) < 0.01 ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "custom_collider: %s\n", error.what());
    return 1;
}
