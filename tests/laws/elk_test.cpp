// SPDX-License-Identifier: MIT
/// A toy elk on wheels rolls into an inflated duck: volume, edges, and who takes what momentum.
#include "measure/deformation.h"
#include "reader/reader.h"
#include "support/scenes.h"

#include <algorithm>
#include <iostream>

namespace plumb::test {
namespace {

class Elk : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, Elk, testing::Values("ode", "bullet"),
                         [](const auto& which) { return which.param; });

constexpr std::uint32_t kGround = 0, kElk = 1;  // its wheels are the bodies behind it

/// Momentum of the elk and its wheels [N s].
Vector momentum_of_elk(const World& w) {
    Vector sum = Vector::Zero();
    for (std::size_t i = kElk; i < w.bodies.size(); ++i)
        sum += w.bodies.mass[i] * w.bodies.velocity[i];
    return sum;
}

Vector momentum_of_duck(const World& w) { return linear_momentum(w) - momentum_of_elk(w); }

/// What the ground took in the last step, from wheels and from the duck [N s].
Vector taken_by_ground(const Simulation& simulation) {
    Vector sum = Vector::Zero();
    for (const BodyContact& c : simulation.contacts())
        if (c.body_a == kGround || c.body_b == kGround)
            sum += c.body_a == kGround ? c.impulse() : Vector(-c.impulse());
    for (const ParticleContact& c : simulation.particle_contacts())
        if (c.body == kGround) sum -= c.normal_impulse * c.normal + c.friction_impulse;
    return sum;
}

/// Share of the duck's edges that are within 5 % of their length at rest.
double share_at_rest(const World& w) {
    const Deformable& duck = w.deformables[0];
    double near = 0, count = 0;
    for (const auto& t : duck.spec.triangles)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            const double rest = (duck.spec.points[a] - duck.spec.points[b]).norm();
            const double now = (w.particles.position[a] - w.particles.position[b]).norm();
            near += std::abs(now / rest - 1) <= 0.05, ++count;
        }
    return near / count;
}

struct Meeting {
    double worst_volume = 0;
    double unbalanced = 0;         ///< momentum that nobody has, of the elk's at the start
    double lost = 0, given = 0;    ///< along the elk's way, of the elk's momentum at the start
    double pushed = 0, ahead = 0;  ///< the duck from its place, the elk of the duck [m]
    double edges = 1;              ///< share_at_rest, the least since the elk is a metre ahead
};

Meeting meet(const std::string& collider, std::uint32_t substeps, std::uint32_t iterations,
             bool multilevel = true) {
    Scene scene = read_scene(PLUMB_SAMPLES "/scenes/elk.json");
    scene.settings.substeps = substeps, scene.settings.position_iterations = iterations;
    scene.settings.multilevel = multilevel;
    Simulation simulation(scene, colliders(), collider);
    simulation.watch_contacts();
    const World& w = simulation.world();
    const auto duck = [&] { return centre_of(w, w.deformables[0]).x(); };
    double mass = 0;
    for (const double m : w.bodies.mass) mass += m;
    for (const double m : w.particles.mass) mass += m;
    mass -= w.bodies.mass[kGround];
    const Vector start = momentum_of_elk(w);
    const double place = duck();
    Vector taken = Vector::Zero();
    Meeting m;
    while (simulation.time() < 3) {
        simulation.step();
        taken += taken_by_ground(simulation);
        m.worst_volume = std::max(m.worst_volume, std::abs(volume_errors(w)[0]));
        const Vector fallen = mass * simulation.time() * scene.settings.gravity;
        const Vector owned = momentum_of_elk(w) + momentum_of_duck(w) + taken - fallen;
        m.unbalanced = std::max(m.unbalanced, (owned - start).norm() / start.norm());
        m.ahead = w.bodies.position[kElk].x() - duck();
        if (m.ahead > 1) m.edges = std::min(m.edges, share_at_rest(w));
    }
    m.pushed = duck() - place;
    m.lost = 1 - momentum_of_elk(w).x() / start.x();
    m.given = (momentum_of_duck(w) + taken).x() / start.x();
    std::cout << substeps << " x " << iterations << ": volume off by " << m.worst_volume
              << ", duck pushed by " << m.pushed << " m, elk ahead by " << m.ahead << " m, lost "
              << m.lost << " of its momentum, edges at rest " << m.edges << ", unbalanced "
              << m.unbalanced << "\n";
    return m;
}

/// At the sample's own settings, of 10 iterations a step, and at twice as many: the elk passes the
/// duck, pushes it on, and leaves its volume and nine in ten of its edges as they were.
TEST_P(Elk, PassesTheDuckAndGivesItsMomentum) {
    for (const std::uint32_t substeps : {2u, 4u}) {
        const Meeting m = meet(GetParam(), substeps, 5);
        EXPECT_LT(m.worst_volume, 0.005);
        EXPECT_LT(m.unbalanced, 1e-6);
        EXPECT_GT(m.lost, 0.1);
        EXPECT_GT(m.pushed, 1);
        EXPECT_GT(m.ahead, 1);
        EXPECT_GE(m.edges, 0.85);
        EXPECT_NEAR(m.given, m.lost, 1e-6);
    }
}

/// Swept alone the duck is too soft there, and the elk stays in it. At the sample's settings its
/// volume is off by one to three per cent, as the run goes.
TEST_P(Elk, GivesItsMomentumToTheDuckAndTheGround) {
    for (const std::uint32_t substeps : {2u, 4u}) {
        const Meeting m = meet(GetParam(), substeps, 5, false);
        EXPECT_LT(m.worst_volume, substeps == 2 ? 0.04 : 0.02);
        EXPECT_LT(m.unbalanced, 1e-6);
        EXPECT_GT(m.lost, 0.1);
        EXPECT_NEAR(m.given, m.lost, 1e-6);
    }
}

/// At the paper's 150 iterations. The duck's skin, which keeps 1.1 times the volume, is stretched
/// by 3 % on the mean.
TEST(ElkInADuckOfRubber, PassesItAndLeavesItInShape) {
    const Meeting m = meet("ode", 30, 5);
    EXPECT_LT(m.worst_volume, 0.001);
    EXPECT_GT(m.pushed, 1);
    EXPECT_GT(m.ahead, 1);
    EXPECT_GE(m.edges, 0.95);
    EXPECT_NEAR(m.given, m.lost, 1e-6);
}

/// Swept alone it takes 400 of them.
TEST(ElkInADuckOfRubber, LeavesItInShapeWhenSwept) {
    const Meeting m = meet("ode", 20, 20, false);
    EXPECT_LT(m.worst_volume, 0.02);
    EXPECT_GT(m.pushed, 1);
    EXPECT_GT(m.ahead, 1);
    EXPECT_GE(m.edges, 0.95);
    EXPECT_NEAR(m.given, m.lost, 1e-6);
}

}  // namespace
}  // namespace plumb::test
