// SPDX-License-Identifier: MIT
/// The drag of the air on surfaces against the formulas of plates, and what it can never do.
#include "scene/wind.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/soft.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class AirDragLaw : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, AirDragLaw, each_precision(), precision_name);

constexpr double kSide = 1.2, kMass = 0.15;

/// A free square sheet, horizontal.
Scene free_sheet(Precision precision, const Vector& wind) {
    Scene s;
    s.settings.precision = precision;
    s.settings.gravity.setZero();
    s.settings.wind = wind;
    add_soft(s, sheet({6, 6}, {kSide, kSide})).mass = kMass;
    return s;
}

/// The particle that is furthest from a velocity is so far from it.
double furthest_from(const World& world, const Vector& velocity) {
    double furthest = 0;
    for (const Vector& v : world.particles.velocity)
        furthest = std::max(furthest, (v - velocity).norm());
    return furthest;
}

/// m g = ½ ρ c A v², at any step.
TEST_P(AirDragLaw, TerminalVelocityIsThatOfTheFormula) {
    for (const std::uint32_t substeps : {1u, 10u}) {
        Scene s = free_sheet(GetParam(), Vector::Zero());
        s.settings.gravity = {0, -9.81, 0};
        s.settings.substeps = substeps;
        const double drag = s.deformables[0].drag, density = s.settings.air_density,
                     speed = std::sqrt(2 * kMass * 9.81 / (density * drag * kSide * kSide));
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 5);
        const double error = furthest_from(simulation.world(), {0, -speed, 0}) / speed;
        std::cout << substeps << " substeps: " << speed << " m/s, off by " << error << "\n";
        EXPECT_LT(error, GetParam() == Precision::single ? 2e-5 : 1e-9);
    }
}

/// v = U k U t / (1 + k U t) with k = ρ c A / 2 m, to the first order of the substep; along the
/// sheet both of its sides count, c = 2 c_f.
TEST_P(AirDragLaw, WindAcceleratesASheetByTheFormula) {
    for (const Vector& direction : {Vector(0, 1, 0), Vector(1, 0, 0)}) {
        double before = 0;
        for (const std::uint32_t substeps : {1u, 2u, 4u}) {
            Scene s = free_sheet(GetParam(), 8 * direction);
            s.settings.substeps = substeps;
            DeformableSpec& spec = s.deformables[0];
            spec.skin_drag = 0.4;
            const double c = direction.y() > 0 ? spec.drag : 2 * spec.skin_drag,
                         k = s.settings.air_density * c * kSide * kSide / (2 * kMass);
            Simulation simulation(s, colliders(), "reference");
            run_for(simulation, 0.2);
            const double kut = k * 8 * 0.2, speed = 8 * kut / (1 + kut);
            const double error = furthest_from(simulation.world(), speed * direction) / speed;
            std::cout << substeps << " substeps: " << speed << " m/s, off by " << error << "\n";
            EXPECT_LT(error, 0.05 / substeps);
            if (before > 0) {
                EXPECT_NEAR(error / before, 0.5, 0.05) << "first order";
            }
            before = error;
        }
    }
}

/// A ball has the drag of a plate of half of its cross section: ½ ρ (c/2) π R² U², the closer the
/// finer its surface is.
TEST_P(AirDragLaw, OnABallIsHalfOfThatOnItsCrossSection) {
    double before = 1;
    for (const std::uint32_t cells : {4u, 8u}) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.gravity.setZero();
        s.settings.wind = Vector(0, 0, 5);
        s.settings.dt = 1e-4;
        DeformableSpec& ball = add_soft(s, balloon(0.3, cells));
        ball.mass = 100, ball.skin_drag = 0;
        const double force =
            0.5 * s.settings.air_density * ball.drag / 2 * std::numbers::pi * 0.09 * 25;
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 0.001);
        const double error =
            std::abs(linear_momentum(simulation.world()).z() / (0.001 * force) - 1);
        std::cout << cells << " cells: off by " << error << "\n";
        EXPECT_LT(error, 0.3 * before);
        before = error;
    }
    EXPECT_LT(before, 0.02);
}

/// Surfaces of both sorts that gusts have crumpled: their momentum gains what the formula says of
/// each triangle, and nothing else.
TEST(AirDragLaws, MomentumGainsTheImpulseOfTheAir) {
    Scene s;
    s.settings.precision = Precision::double_;
    s.settings.gravity.setZero();
    s.settings.wind = Vector(3, -1, 2);
    s.settings.forbid = {"contacts"};
    add_soft(s, sheet({8, 8}, {1, 1})).mass = 0.1;
    add_soft(s, balloon(0.3, 4, {2, 0, 0})).mass = 0.1;
    s.deformables[0].elasticity.youngs_modulus = s.deformables[1].elasticity.youngs_modulus = 1e3;
    s.settings.gusts = {2, 3, 1}, s.settings.gust_period = 0.3;
    Simulation crumpled(s, colliders(), "reference");
    run_for(crumpled, 1);
    Scene again = s;
    again.settings.gusts.setZero(), again.settings.dt = 1e-7;
    for (std::size_t i = 0, d = 0; d < again.deformables.size(); ++d)
        for (Vector& p : again.deformables[d].points) p = crumpled.world().particles.position[i++];
    again.deformables[0].velocity = {-1, 2, 0}, again.deformables[1].velocity = {0, 1, -2};
    Simulation measured(again, colliders(), "reference");
    Vector force = Vector::Zero();
    for (const DeformableSpec& spec : again.deformables) {
        const bool closed = spec.kind == DeformableKind::balloon;
        const double half = 0.5 * 1.2 * (closed ? 0.5 : 1);
        for (const auto& t : spec.triangles) {
            const Vector e = (spec.points[t[1]] - spec.points[t[0]])
                                 .cross(spec.points[t[2]] - spec.points[t[0]]);
            const Vector n = e.normalized(), w = *s.settings.wind - spec.velocity;
            const double across = w.dot(n);
            const Vector along = w - across * n;
            force += half * 0.5 * e.norm() *
                     (spec.drag * std::abs(across) * across * n +
                      2 * spec.skin_drag * along.norm() * along);
        }
    }
    const Vector before = linear_momentum(measured.world());
    measured.step();
    const Vector gained = linear_momentum(measured.world()) - before;
    const double error = (gained / again.settings.dt - force).norm() / force.norm();
    std::cout << "force " << force.norm() << " N, off by " << error << "\n";
    EXPECT_LT(error, 1e-5);
}

/// Seen from the air, a surface that was at rest is only ever slowed: as a whole its energy never
/// grows, so that it is never faster than the wind. Light and fine ones, in strong winds, over long
/// steps.
TEST_P(AirDragLaw, NothingIsEverFasterThanTheWind) {
    Random random(11);
    for (int draw = 0; draw < 12; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.gravity.setZero();
        s.settings.dt = std::pow(10, random.number(-3, -1));
        s.settings.substeps = 1 + random.below(4);
        const Vector wind = std::pow(10, random.number(0, 2)) * random.direction();
        s.settings.wind = wind;
        const std::uint32_t cells = 4 + random.below(10);
        DeformableSpec spec =
            draw % 3 == 0 ? balloon(0.4, 2 + cells / 4) : sheet({cells, cells}, {1, 1});
        const Rotation turn = random.rotation();
        for (Vector& p : spec.points) p = turn * p;
        spec.mass = std::pow(10, random.number(-5, -1));
        spec.drag = std::pow(10, random.number(-1, 2));
        spec.elasticity.youngs_modulus = std::pow(10, random.number(3, 7));
        add_soft(s, std::move(spec));
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ": " << s.settings.dt << " s, " << wind.norm()
                     << " m/s, " << *s.deformables[0].mass << " kg");
        Simulation simulation(s, colliders(), "reference");
        const Particles& p = simulation.world().particles;
        const auto energy = [&] {
            double sum = 0;
            for (std::size_t i = 0; i < p.size(); ++i)
                sum += p.mass[i] * (p.velocity[i] - wind).squaredNorm();
            return sum;
        };
        const double start = energy();
        double most = 0;
        for (int i = 0; i < 60; ++i) {
            ASSERT_TRUE(simulation.step().finite);
            most = std::max(most, energy() / start);
        }
        std::cout << "draw " << draw << ": at most " << most << ", at the end " << energy() / start
                  << "\n";
        EXPECT_LE(most, 1 + 1e-6);
    }
}

/// Gusts swing about the wind, and never by more than they are said to.
TEST(AirDragLaws, GustsSwingAboutTheWind) {
    Settings s;
    s.wind = Vector(4, 0, -1), s.gusts = {2, 0.5, 1}, s.gust_period = 2;
    EXPECT_EQ(wind_at(s, 0), *s.wind);
    Vector mean = Vector::Zero(), most = Vector::Zero();
    constexpr int kTimes = 100000;
    for (int i = 0; i < kTimes; ++i) {
        const Vector gust = wind_at(s, 0.01 * i) - *s.wind;
        mean += gust / kTimes, most = most.cwiseMax(gust.cwiseAbs());
    }
    EXPECT_LT(mean.norm(), 0.01);
    EXPECT_LT((most - s.gusts).norm(), 1e-3);
    EXPECT_NEAR(wind_at(s, 0.5).x(), 6, 1e-12);
}

}  // namespace
}  // namespace plumb::test
