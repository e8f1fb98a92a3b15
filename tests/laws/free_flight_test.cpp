// SPDX-License-Identifier: MIT
/// Free flight at any rate: what turns by itself keeps its angular momentum, vector and all, and
/// its energy. Steps: 0.01 s, 1/60 s with 20 substeps, and others at random.
#include "support/random.h"
#include "support/scenes.h"

#include <iostream>

namespace plumb::test {
namespace {

/// Half sizes [m]: a book, nearly a cube, nearly a disc, a needle, a plate, a disc and a rod.
const Vector kBoxes[] = {{0.1, 0.2, 0.3},     {0.2, 0.2001, 0.2}, {0.3, 0.05, 0.30001},
                         {0.5, 0.005, 0.006}, {0.5, 0.4, 0.005},  {0.3, 0.05, 0.3},
                         {0.05, 0.4, 0.05}};

/// Boxes that touch nothing: each half size spun at `rate` about its axes, nearly about them, and
/// about axes at random.
Scene boxes_in_flight(const Settings& settings, const std::vector<double>& rates, Random& random) {
    Scene s;
    s.settings = settings;
    s.settings.gravity.setZero();
    int place = 0;
    for (const Vector& half : kBoxes)
        for (const double rate : rates)
            for (int i = 0; i < 8; ++i) {
                const Vector axis = i < 3   ? Vector(Vector::Unit(i))
                                    : i < 6 ? Vector(Vector::Unit(i - 3) + random.vector(1e-3))
                                            : random.vector();
                BodySpec& b = add_body(s, box(half.x(), half.y(), half.z()),
                                       {3.0 * (place % 20), 3.0 * (place / 20), 0});
                b.placement.rotation = random.rotation();
                b.angular_velocity = b.placement.rotation * (rate * axis.normalized());
                b.mask = 0;
                ++place;
            }
    return s;
}

/// I ω of one body, world frame [kg m²/s].
Vector spin_of(const World& w, std::size_t i) {
    const Rotation& q = w.bodies.orientation[i];
    return q * w.bodies.inertia[i].cwiseProduct(q.conjugate() * w.bodies.angular_velocity[i]);
}

/// Greatest relative departures of any body over a run.
struct Lost {
    double momentum = 0, energy = 0;
};
Lost lost_in(Simulation& simulation, double seconds) {
    const World& w = simulation.world();
    std::vector<Vector> start;
    std::vector<double> energy;
    for (std::size_t i = 0; i < w.bodies.size(); ++i) {
        start.push_back(spin_of(w, i));
        energy.push_back(start[i].dot(w.bodies.angular_velocity[i]));
    }
    Lost lost;
    const auto steps = std::llround(seconds / w.settings.dt);
    for (long long k = 1; k <= steps; ++k) {
        simulation.step();
        if (k % 7 != 0 && k != steps) continue;
        for (std::size_t i = 0; i < w.bodies.size(); ++i) {
            const Vector l = spin_of(w, i);
            lost.momentum = std::max(lost.momentum, (l - start[i]).norm() / start[i].norm());
            lost.energy = std::max(lost.energy,
                                   std::abs(l.dot(w.bodies.angular_velocity[i]) / energy[i] - 1));
        }
    }
    return lost;
}

void expect_nothing_lost(const Settings& settings, const std::vector<double>& rates, double seconds,
                         Random& random, const std::string& where) {
    Simulation simulation(boxes_in_flight(settings, rates, random), colliders(), "reference");
    const Lost lost = lost_in(simulation, seconds);
    std::cout << where << ": momentum off by " << lost.momentum << ", energy by " << lost.energy
              << "\n";
    EXPECT_LT(lost.momentum, 1e-6) << where;
    EXPECT_LT(lost.energy, 1e-6) << where;
}

TEST(FreeFlight, KeepsMomentumAndEnergyForAMinute) {
    Random random(1);
    for (const double rate : {0.1, 5.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0})
        expect_nothing_lost({}, {rate}, 60, random, "h10, " + std::to_string(rate) + " rad/s");
}

TEST(FreeFlight, KeepsThemWithSubsteps) {
    Random random(2);
    Settings s;
    use_fine_steps(s);
    expect_nothing_lost(s, {1, 30, 300, 1000}, 5, random, "s20");
}

TEST(FreeFlight, KeepsThemAtAnySettings) {
    Random random(3);
    for (int i = 0; i < 12; ++i) {
        Settings s;
        s.dt = random.number(0.001, 0.02);
        s.substeps = 1 + random.below(40);
        s.precision = i % 2 == 0 ? Precision::single : Precision::double_;
        const double rate = std::pow(10.0, random.number(-1, 3.3));
        expect_nothing_lost(s, {rate}, 100 * s.dt, random,
                            std::to_string(s.dt) + " s x " + std::to_string(s.substeps) + ", " +
                                std::to_string(rate) + " rad/s");
    }
}

/// A body of two equal moments: its axis goes round L at |L|/I₁ without end.
TEST(FreeFlight, ASymmetricBodyPrecessesByItsFormula) {
    for (const double rate : {5.0, 20.0, 80.0, 300.0}) {
        Scene s;
        s.settings.gravity.setZero();
        BodySpec& b = add_body(s, box(0.3, 0.05, 0.3), Vector::Zero());
        b.angular_velocity = rate * Vector(0.3, 1, 0.1).normalized();
        Simulation simulation(s, colliders(), "reference");
        const World& w = simulation.world();
        const Vector l = spin_of(w, 0);
        const Vector moments = w.bodies.inertia[0];
        // which of the principal axes is the one apart
        int apart = 0;
        for (int k = 0; k < 3; ++k)
            if (std::abs(moments[k] - moments[(k + 1) % 3]) > 1e-9 &&
                std::abs(moments[k] - moments[(k + 2) % 3]) > 1e-9)
                apart = k;
        const auto axis = [&] { return Vector(w.bodies.orientation[0] * Vector::Unit(apart)); };
        const Vector start = axis();
        run_for(simulation, 10);
        const Eigen::AngleAxisd round(10 * l.norm() / moments[(apart + 1) % 3], l.normalized());
        const double off = (axis() - round * start).norm();
        std::cout << rate << " rad/s: axis off by " << off << "\n";
        EXPECT_LT(off, 1e-4) << rate << " rad/s";
    }
}

class SpinApart : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, SpinApart, every_collider(), where_name);

/// Boxes in a row, which spin in spheres that do not meet: what a point of one runs towards another
/// with is no approach. In every other draw the row drifts, by less than would let two of them
/// meet.
TEST_P(SpinApart, BodiesInSpheresThatDoNotMeetLeaveEachOtherAlone) {
    Random random(5);
    for (int draw = 0; draw < 12; ++draw) {
        Scene s = scene();
        s.settings.gravity.setZero();
        if (draw == 1) use_fine_steps(s.settings);
        if (draw > 1) {
            s.settings.dt = random.number(0.001, 0.02);
            s.settings.substeps = 1 + random.below(40);
        }
        const double rate = std::pow(10.0, random.number(1, 3));
        const Vector half(0.1, 0.2, 0.3);
        const double between = random.number(0.02, 0.5), apart = 2 * half.norm() + between;
        const Vector drift(draw % 2 ? 0.4 * (between - s.settings.margin) / s.settings.dt : 0, 0,
                           0);
        for (int i = 0; i < 8; ++i) {
            BodySpec& b = add_body(s, box(half), {apart * i, 0, 0});
            b.placement.rotation = random.rotation();
            b.angular_velocity = rate * random.vector().normalized();
            b.velocity = drift;
        }
        Simulation simulation(s, colliders(), collider());
        std::vector<Vector> spins;
        for (std::size_t i = 0; i < 8; ++i) spins.push_back(spin_of(simulation.world(), i));
        run_for(simulation, 100 * s.settings.dt);
        for (std::size_t i = 0; i < 8; ++i) {
            const World& w = simulation.world();
            EXPECT_LT((w.bodies.velocity[i] - drift).norm(), 1e-9) << rate << " rad/s, " << apart;
            EXPECT_LT((spin_of(w, i) - spins[i]).norm(), 1e-6 * spins[i].norm());
        }
    }
}

/// A paddle that spins fast strikes a ball that comes into its circle, from afar and at rest.
TEST_P(SpinApart, WhatComesIntoTheSphereIsStruck) {
    for (const double rate : {30.0, 300.0}) {
        Scene s = scene();
        s.settings.gravity.setZero();
        BodySpec& paddle = add_body(s, box(0.5, 0.1, 0.1), Vector::Zero());
        paddle.angular_velocity = {0, 0, rate};
        add_body(s, sphere(0.1), {1.5, 0, 0}).velocity = {-3, 0, 0};
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 1);
        const Vector& v = simulation.world().bodies.velocity[1];
        EXPECT_GT(v.norm(), 3.1) << rate << " rad/s: " << v.transpose();
        EXPECT_LT(std::abs(simulation.world().bodies.angular_velocity[0].z()), rate);
    }
}

}  // namespace
}  // namespace plumb::test
