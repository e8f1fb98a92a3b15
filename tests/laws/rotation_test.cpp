// SPDX-License-Identifier: MIT
/// Free rotation: the three gyroscopic integrators on a box, and free flight.
#include "support/scenes.h"

#include <algorithm>
#include <iostream>

namespace plumb::test {
namespace {

/// Half sizes 0.1, 0.2, 0.3 m, spun at 20 rad/s about the middle axis with a hundredth beside it; h
/// = 5 ms.
Scene spinning_box(Gyroscopic form) {
    Scene s;
    s.settings.gravity.setZero();
    s.settings.dt = 0.005;
    s.settings.gyroscopic = form;
    add_body(s, box(0.1, 0.2, 0.3), Vector::Zero()).angular_velocity = {0.2, 20, 0.2};
    return s;
}

/// Greatest relative departures over a run.
struct Departure {
    double energy = 0, momentum = 0, end_energy = 1;
};
Departure departure(Gyroscopic form, double seconds) {
    Simulation simulation(spinning_box(form), colliders(), "reference");
    const double e0 = kinetic_energy(simulation.world());
    const Vector l0 = angular_momentum(simulation.world());
    Departure d;
    const auto steps = std::llround(seconds / 0.005);
    for (long long i = 0; i < steps; ++i) {
        if (!simulation.step().finite) return {INFINITY, INFINITY, INFINITY};
        d.end_energy = kinetic_energy(simulation.world()) / e0;
        d.energy = std::max(d.energy, std::abs(d.end_energy - 1));
        d.momentum =
            std::max(d.momentum, (angular_momentum(simulation.world()) - l0).norm() / l0.norm());
    }
    return d;
}

TEST(Rotation, ConservingFormKeepsEnergyAndMomentumForAHundredSeconds) {
    const Departure d = departure(Gyroscopic::conserving, 100);
    std::cout << "conserving: energy off by " << d.energy << ", angular momentum by " << d.momentum
              << "\n";
    EXPECT_LT(d.energy, 1e-3);
    EXPECT_LT(d.momentum, 1e-3);
}

TEST(Rotation, ThePapersExplicitFormGrows) {
    const Departure at_1s = departure(Gyroscopic::explicit_, 1),
                    at_10s = departure(Gyroscopic::explicit_, 10);
    std::cout << "explicit: energy times " << at_1s.end_energy << " after 1 s, times "
              << at_10s.end_energy << " after 10 s\n";
    EXPECT_GT(at_10s.end_energy, 1.5);
}

TEST(Rotation, TheImplicitFormNeverGains) {
    const Departure d = departure(Gyroscopic::implicit, 100);
    std::cout << "implicit: energy times " << d.end_energy << " after 100 s\n";
    EXPECT_LE(d.end_energy, 1.0001);
}

/// Symplectic Euler's bias against the parabola is exactly ½ g h t.
TEST(Rotation, FreeFallHasTheBiasOfSymplecticEuler) {
    for (Precision p : {Precision::single, Precision::double_})
        for (double h : {0.1, 0.01, 1e-6}) {
            Scene s;
            s.settings.dt = h;
            s.settings.precision = p;
            add_body(s, sphere(0.1), {0, 0, 0}).velocity = {1, 2, 3};
            Simulation simulation(s, colliders(), "reference");
            for (int i = 0; i < 100; ++i) simulation.step();
            const double t = 100 * h;
            const Vector law(t, 2 * t - 0.5 * 9.81 * t * t - 0.5 * 9.81 * h * t, 3 * t);
            EXPECT_LT((simulation.world().bodies.position[0] - law).norm(), 1e-9) << "h " << h;
        }
}

}  // namespace
}  // namespace plumb::test
