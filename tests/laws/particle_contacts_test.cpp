// SPDX-License-Identifier: MIT
/// Particles on bodies: where they rest, their friction, and what they bear.
#include "support/scenes.h"
#include "support/soft.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class ParticleContacts : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, ParticleContacts, every_collider(), where_name);

class ParticleFriction : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, ParticleFriction, each_precision(), precision_name);

/// Two particles that hardly feel each other.
DeformableSpec two_particles(const Vector& a, const Vector& b, double radius) {
    DeformableSpec spec = rope(a, b, 1);
    spec.elasticity.youngs_modulus = 1e-6;
    spec.mass = 0.2, spec.radius = radius;
    return spec;
}

TEST_P(ParticleContacts, RestAtTheirRadius) {
    constexpr double kRadius = 0.02;
    Scene s = scene();
    add_ground(s);
    add_body(s, box(0.5, 0.25, 0.5), {3, 0.25, 0}, Motion::fixed);
    add_body(s, sphere(0.5), {6, 0, 0}, Motion::fixed);
    add_body(s, box(0.3, 0.2, 0.3), {9, 0.2, 0}).mass = 10;
    add_soft(s, two_particles({0, 0.1, 0}, {0.3, 0.04, 0.1}, kRadius));
    add_soft(s, two_particles({3.1, 0.6, 0.1}, {2.8, 0.53, 0}, kRadius));
    add_soft(s, two_particles({6, 0.55, 0}, {6, 0.05, 0.7}, kRadius));  // the second on the ground
    add_soft(s, two_particles({9.1, 0.45, 0}, {8.9, 0.5, 0.1}, kRadius));
    Simulation simulation(s, colliders(), collider());
    run_for(simulation, 2);
    const std::vector<Vector>& p = simulation.world().particles.position;
    const double heights[] = {0, 0, 0.5, 0.5, 0.5, 0, 0.4, 0.4};
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NEAR(p[i].y() - heights[i], kRadius, 1e-4) << "particle " << i;
    for (const std::size_t i : {0u, 1u, 2u, 3u, 6u, 7u})
        EXPECT_LT(simulation.world().particles.velocity[i].norm(), 1e-4) << "particle " << i;
}

/// What bears particles bears their weight.
TEST_P(ParticleContacts, BearTheWeight) {
    Scene s = scene();
    add_ground(s);
    add_soft(s, two_particles({3, 0.021, 0}, {3.3, 0.021, 0}, 0.02));
    Simulation simulation(s, colliders(), collider());
    simulation.watch_contacts();
    run_for(simulation, 1);
    double sum = 0, time = 0;
    while (simulation.time() < 2) {
        simulation.step();
        time += s.settings.dt;
        for (const ParticleContact& c : simulation.particle_contacts()) sum += c.normal_impulse;
    }
    EXPECT_NEAR(sum / time / (0.2 * 9.81), 1, 0.001);
}

/// A patch of cloth on a slope, which is a box turned by the angle.
double slide(Precision precision, double friction, double angle, bool fine) {
    Scene s;
    s.settings.precision = precision;
    if (fine) use_fine_steps(s.settings);
    s.materials[0].friction = friction;
    const Rotation turn(Eigen::AngleAxisd(angle, Vector::UnitZ()));
    BodySpec& slope = add_body(s, box(10, 0.5, 2), {0, 0, 0}, Motion::fixed);
    slope.placement.rotation = turn;
    DeformableSpec patch = sheet({4, 4}, {0.2, 0.2});
    for (Vector& p : patch.points) p = turn * (p + Vector(0, 0.51, 0));
    patch.radius = 0.01, patch.mass = 0.1;
    add_soft(s, std::move(patch));
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 1);
    Vector moved = Vector::Zero();
    for (std::size_t i = 0; i < 25; ++i)
        moved += (simulation.world().particles.position[i] - s.deformables[0].points[i]) / 25;
    return (turn.conjugate() * moved).x();
}

TEST_P(ParticleFriction, ClothHoldsBelowTheAngleAndSlidesAboveIt) {
    for (const double friction : {0.2, 0.6})
        for (const bool fine : {false, true}) {
            const double angle = std::atan(friction);
            const double held = slide(GetParam(), friction, angle - 0.02, fine),
                         slid = slide(GetParam(), friction, angle + 0.1, fine);
            const double law =
                -0.5 * 9.81 * (std::sin(angle + 0.1) - friction * std::cos(angle + 0.1));
            std::cout << friction << (fine ? " fine" : " coarse") << ": held by " << held
                      << ", slid " << slid / law << "\n";
            EXPECT_LT(std::abs(held), 1e-3);
            EXPECT_NEAR(slid / law, 1, 0.03);
        }
}

/// A ball that falls onto a sheet that is held around its rim.
TEST_P(ParticleFriction, ABallOnATrampolineStaysAboveIt) {
    for (const double speed : {0.0, 8.0}) {
        Scene s;
        s.settings.precision = GetParam();
        use_fine_steps(s.settings);
        s.settings.substeps = 40;
        s.settings.forbid = {"surface_contacts"};  // so that particles alone bear the ball
        s.settings.velocity_iterations = s.settings.position_iterations = 5;
        add_body(s, sphere(0.2), {0, 0.6, 0}).velocity = {0, -speed, 0};
        s.bodies[0].mass = 2;
        DeformableSpec cloth = sheet({12, 12}, {1.2, 1.2});
        cloth.mass = 1, cloth.radius = 0.02;
        cloth.elasticity.youngs_modulus = 1e6, cloth.elasticity.damping = 0.05;
        add_soft(s, std::move(cloth));
        std::vector<std::uint32_t> rim;
        for (std::uint32_t i = 0; i < 13 * 13; ++i)
            if (i % 13 == 0 || i % 13 == 12 || i < 13 || i >= 12 * 13) rim.push_back(i);
        hold(s, 0, rim);
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        double deepest = 0, lowest = 0, sum = 0;
        int steps = 0;
        simulation.watch_contacts();
        while (simulation.time() < 3) {
            ASSERT_TRUE(simulation.step().finite);
            for (const Vector& p : world.particles.position)
                deepest = std::max(deepest, 0.22 - (p - world.bodies.position[0]).norm());
            lowest = std::min(lowest, world.bodies.position[0].y());
            if (simulation.time() < 2.5) continue;
            ++steps;
            for (const ParticleContact& c : simulation.particle_contacts())
                sum -= (c.normal_impulse * c.normal + c.friction_impulse).y() / s.settings.dt;
        }
        std::cout << speed << " m/s: deepest overlap " << deepest << ", lowest " << lowest
                  << ", height " << world.bodies.position[0].y() << ", bears "
                  << sum / steps / (2 * 9.81) << " of the weight\n";
        EXPECT_LT(deepest, 0.01);
        EXPECT_GT(lowest, -0.6);
        EXPECT_NEAR(sum / steps / (2 * 9.81), 1, 0.01);
    }
}

/// A shot does not pass a sheet by in a step: what it may meet is found before it is there.
TEST_P(ParticleFriction, AFastBallIsCaught) {
    Scene s;
    s.settings.precision = GetParam();
    s.settings.gravity.setZero();
    s.settings.dt = 1.0 / 60, s.settings.substeps = 20;
    add_body(s, sphere(0.05), {0.03, 0.5, 0.02}).velocity = {0, -60, 0};
    s.bodies[0].mass = 0.05;
    DeformableSpec cloth = sheet({12, 12}, {0.5, 0.5});
    cloth.mass = 5, cloth.radius = 0.02;
    cloth.elasticity.youngs_modulus = 1e6, cloth.elasticity.damping = 0.01;
    add_soft(s, std::move(cloth));
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 0.5);
    const Vector v = simulation.world().bodies.velocity[0];
    std::cout << "it moves at " << v.transpose() << " m/s\n";
    EXPECT_LT(v.norm(), 20) << "it has passed";
}

}  // namespace
}  // namespace plumb::test
