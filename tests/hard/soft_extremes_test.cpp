// SPDX-License-Identifier: MIT
/// Deformables at their limits: many light points, heavy loads, strong pulls, squashed solids.
#include "support/random.h"
#include "support/scenes.h"
#include "support/soft.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class SoftExtremes : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, SoftExtremes, each_precision(), precision_name);

/// Points and speeds stay within bounds that energy sets: `fall` is the greatest height that
/// anything could have fallen [m].
void expect_bounded(Simulation& simulation, double seconds, double fall, double extent) {
    const World& world = simulation.world();
    double fastest = 0, furthest = 0;
    while (simulation.time() < seconds) {
        ASSERT_TRUE(simulation.step().finite) << "at " << simulation.time() << " s";
        for (std::size_t i = 0; i < world.particles.size(); ++i) {
            fastest = std::max(fastest, world.particles.velocity[i].norm());
            furthest = std::max(furthest, world.particles.position[i].norm());
        }
    }
    std::cout << "fastest " << fastest << " m/s, furthest " << furthest << " m\n";
    EXPECT_LT(fastest, 3 * std::sqrt(2 * 9.81 * fall));
    EXPECT_LT(furthest, extent);
}

/// A sheet of 2 m by 2 m and n by n points, 1 kg altogether, held at its corners.
Scene held_sheet(Precision precision, std::uint32_t n) {
    Scene s;
    s.settings.precision = precision;
    DeformableSpec cloth = sheet({n - 1, n - 1}, {2, 2});
    cloth.mass = 1;
    add_soft(s, std::move(cloth));
    hold(s, 0, {0, n - 1, n * (n - 1), n * n - 1});
    return s;
}

TEST_P(SoftExtremes, AFineSheetHangsByItsCorners) {
    Simulation coarse(held_sheet(GetParam(), 50), colliders(), "reference");
    expect_bounded(coarse, 5, 10, 10);
    Simulation fine(held_sheet(GetParam(), 100), colliders(), "reference");
    expect_bounded(fine, 0.5, 10, 10);
}

TEST_P(SoftExtremes, AVeryFineSheetHangsByItsCorners) {
    Simulation simulation(held_sheet(GetParam(), 200), colliders(), "reference");
    expect_bounded(simulation, 0.5, 10, 10);
}

/// A ball of a hundred times the cloth's mass.
Scene heavy_ball(Precision precision) {
    Scene s;
    s.settings.precision = precision;
    DeformableSpec cloth = sheet({20, 20}, {2, 2});
    cloth.mass = 1, cloth.radius = 0.03;
    add_soft(s, std::move(cloth));
    std::vector<std::uint32_t> rim;
    for (std::uint32_t i = 0; i < 21 * 21; ++i)
        if (i % 21 == 0 || i % 21 == 20 || i < 21 || i >= 20 * 21) rim.push_back(i);
    hold(s, 0, rim);
    add_body(s, sphere(0.3), {0.02, 0.35, 0.01}).mass = 100;
    return s;
}

TEST_P(SoftExtremes, ASheetBearsAHeavyBall) {
    Scene s = heavy_ball(GetParam());
    use_fine_steps(s.settings);
    Simulation simulation(s, colliders(), "reference");
    expect_bounded(simulation, 3, 10, 10);
    std::cout << "ball at " << simulation.world().bodies.position[0].transpose() << "\n";
}

/// Both as one system: the ball in fine steps, for contacts are swept all the same.
TEST_P(SoftExtremes, SheetsAsOneSystem) {
    Random random(31);
    for (int draw = 0; draw < 4; ++draw) {
        Scene s = held_sheet(GetParam(), 20 + 5 * draw);
        s.settings.exact_deformables = 2000;
        if (draw > 0) {
            s.settings.dt = random.number(0.002, 0.02);
            s.settings.substeps = 1 + random.below(8);
            s.settings.position_iterations = 1 + random.below(8);
        }
        Simulation simulation(s, colliders(), "reference");
        expect_bounded(simulation, 2, 10, 10);
    }
    Scene s = heavy_ball(GetParam());
    use_fine_steps(s.settings);
    s.settings.exact_deformables = 2000;
    Simulation simulation(s, colliders(), "reference");
    expect_bounded(simulation, 1, 10, 10);
}

/// 10⁴ N pull a cloth apart between two bodies. In usual steps nothing breaks; in those that carry
/// the load across, E t = 10⁵ N/m lets it swing by at most twice 10 %.
TEST_P(SoftExtremes, ASheetIsPulledApart) {
    for (const bool fine : {false, true}) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.gravity.setZero();
        s.settings.forbid = {"contacts"};
        if (fine) s.settings.substeps = s.settings.position_iterations = 20;
        DeformableSpec cloth = sheet({16, 16}, {1, 1});
        cloth.mass = 0.5, cloth.elasticity.youngs_modulus = 1e8;
        add_soft(s, std::move(cloth));
        std::vector<std::uint32_t> left, right;
        for (std::uint32_t i = 0; i < 17; ++i) left.push_back(17 * i), right.push_back(17 * i + 16);
        for (const double side : {-1.0, 1.0}) {
            BodySpec& bar = add_body(s, box(0.05, 0.05, 0.6), {0.55 * side, 0, 0});
            bar.mass = 10, bar.force = {1e4 * side, 0, 0};
        }
        hold(s, 0, left, 0);
        hold(s, 0, right, 1);
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        double widest = 0, momentum = 0;
        while (simulation.time() < 1) {
            ASSERT_TRUE(simulation.step().finite) << "at " << simulation.time() << " s";
            widest = std::max(widest, (world.bodies.position[1] - world.bodies.position[0]).norm());
            momentum = std::max(momentum, linear_momentum(world).norm());
        }
        std::cout << "widest " << widest << " m, momentum " << momentum << "\n";
        if (fine) {
            EXPECT_LT(widest, 1.4);
        }
        EXPECT_LT(momentum, 1e4 * (GetParam() == Precision::single ? 1e-5 : 1e-12));
    }
}

/// A solid that starts flat, or inside out, finds its shape again.
TEST_P(SoftExtremes, ASquashedSolidComesBack) {
    for (const double factor : {0.05, -0.5}) {
        Scene s;
        s.settings.precision = GetParam();
        use_fine_steps(s.settings);
        s.settings.position_iterations = 5;
        s.settings.gravity.setZero();
        s.settings.forbid = {"contacts"};
        DeformableSpec solid = block({0.2, 0.2, 0.2}, {4, 4, 4});
        solid.mass = 5, solid.elasticity.youngs_modulus = 2e4, solid.elasticity.damping = 0.02;
        const std::vector<Vector> rest = solid.points;
        add_soft(s, std::move(solid));
        Simulation simulation(s, colliders(), "reference");
        // as a program cannot place particles, bodies that are gone at once would have to; speeds
        // do
        World& world = const_cast<World&>(simulation.world());
        for (std::size_t i = 0; i < rest.size(); ++i)
            world.particles.position[i].y() = factor * rest[i].y();
        for (int i = 0; i < 300; ++i) ASSERT_TRUE(simulation.step().finite);
        double worst = 0;
        for (std::size_t i = 0; i < rest.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                worst = std::max(
                    worst,
                    std::abs((world.particles.position[i] - world.particles.position[j]).norm() -
                             (rest[i] - rest[j]).norm()));
        std::cout << "squashed to " << factor << ": off by " << worst << " m\n";
        EXPECT_LT(worst, 0.005) << factor;
    }
}

/// A kinematic plate presses a balloon flat on the ground.
TEST_P(SoftExtremes, APlatePressesABalloon) {
    Scene s;
    s.settings.precision = GetParam();
    s.settings.substeps = 4;
    add_ground(s);
    BodySpec& plate = add_body(s, box(1, 0.1, 1), {0, 0.75, 0}, Motion::kinematic);
    Keyframe from, to, back;
    from.placement.position = plate.placement.position;
    to.time = 1, to.placement.position = {0, 0.16, 0};
    back.time = 2, back.placement.position = from.placement.position;
    plate.script.keyframes = {from, to, back};
    DeformableSpec ball = balloon(0.3, 6, {0, 0.32, 0});
    ball.mass = 0.5, ball.radius = 0.01, ball.elasticity.youngs_modulus = 1e5;
    add_soft(s, std::move(ball));
    Simulation simulation(s, colliders(), "reference");
    expect_bounded(simulation, 4, 20, 20);
}

struct Pressed {
    double fastest;  ///< point, while it is pressed and after [m/s]
    double off;      ///< from their lengths at rest, in the mean over the edges at the end
};

/// A plate presses a solid of 0.3 m of height flat, most of them into the ground, for half a
/// second.
Pressed press_flat(Scene s, DeformableSpec solid, Random& random) {
    add_ground(s);
    const DeformableSpec at_rest = add_soft(s, std::move(solid));
    const double top = 0.31 + 2 * at_rest.radius, end = random.number(-0.04, 0.02);
    BodySpec& plate = add_body(s, box(0.6, 0.05, 0.6), {0, top + 0.1, 0}, Motion::kinematic);
    Keyframe from, flat, leave, up;
    from.placement.position = plate.placement.position;
    flat.time = (top + 0.05 - end) / random.number(0.1, 2);
    flat.placement.position = {0, end + 0.05, 0};
    leave.time = flat.time + 0.5, leave.placement.position = flat.placement.position;
    up.time = leave.time + 0.5, up.placement.position = {0, top + 1, 0};
    plate.script.keyframes = {from, flat, leave, up};
    Simulation simulation(s, colliders(), "reference");
    const World& world = simulation.world();
    Pressed pressed{0, 0};
    while (simulation.time() < up.time + 2) {
        EXPECT_TRUE(simulation.step().finite) << "at " << simulation.time() << " s";
        for (const Vector3d& v : world.particles.velocity)
            pressed.fastest = std::max(pressed.fastest, v.norm());
    }
    std::size_t edges = 0;
    for (const auto& t : at_rest.tetrahedra)
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j, ++edges)
                pressed.off += std::abs(
                    (world.particles.position[t[i]] - world.particles.position[t[j]]).norm() /
                        (at_rest.points[t[i]] - at_rest.points[t[j]]).norm() -
                    1);
    pressed.off /= static_cast<double>(edges);
    std::cout << "fastest " << pressed.fastest << " m/s, edges off by " << pressed.off << "\n";
    return pressed;
}

/// No point gets faster than the energy of a flat solid would make all of it, and the shape comes
/// back.
TEST_P(SoftExtremes, APlatePressesASolidFlat) {
    Random random(41);
    for (int draw = 0; draw < 16; ++draw) {
        SCOPED_TRACE(draw);
        Scene s;
        s.settings.precision = GetParam();
        if (draw > 0) {
            s.settings.dt = random.number(0.002, 0.02);
            s.settings.substeps = 1 + random.below(6);
            s.settings.position_iterations = 1 + random.below(10);
        }
        const double radius = random.number(0.005, 0.02);
        DeformableSpec solid = block({0.2, 0.15, 0.2}, {4, 3, 4}, {0, 0.16 + radius, 0});
        solid.mass = random.number(0.2, 5), solid.radius = radius;
        const double young = std::pow(10, random.number(4, 7)), nu = random.number(0, 0.45),
                     mass = *solid.mass, volume = 0.4 * 0.3 * 0.4;
        solid.elasticity.youngs_modulus = young, solid.elasticity.poissons_ratio = nu;
        solid.elasticity.damping = draw % 2 == 0 ? 0.01 : 0;
        const Pressed pressed = press_flat(std::move(s), std::move(solid), random);
        // of one principal stretch that is 0
        const double energy = volume * young * (1 - nu) / (2 * (1 + nu) * (1 - 2 * nu));
        EXPECT_LT(pressed.fastest, std::sqrt(2 * energy / mass));
        EXPECT_LT(pressed.off, 0.006);
    }
}

/// What is next to incompressible comes back as well, as one system.
TEST_P(SoftExtremes, APlatePressesWhatCanHardlyBeCompressed) {
    Random random(43);
    for (int draw = 0; draw < 4; ++draw) {
        SCOPED_TRACE(draw);
        Scene s;
        s.settings.precision = GetParam();
        s.settings.exact_deformables = 1000;
        DeformableSpec solid = block({0.2, 0.15, 0.2}, {3, 2, 3}, {0, 0.17, 0});
        solid.mass = random.number(1, 50), solid.radius = 0.01;
        solid.elasticity.youngs_modulus = std::pow(10, random.number(6, 7));
        solid.elasticity.poissons_ratio = 0.5 - std::pow(10, random.number(-4, -2));
        solid.elasticity.damping = 0.01;
        EXPECT_LT(press_flat(std::move(s), std::move(solid), random).off, 0.006);
    }
}

/// Of each kind all there is tears, down to single points, which fall on: over any steps, in wind.
TEST_P(SoftExtremes, WhatTearsMayTearUntilNothingIsLeft) {
    Random random(21);
    std::size_t all = 0;
    for (int draw = 0; draw < 16; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.dt = random.number(0.002, 0.03), s.settings.substeps = 1 + random.below(4);
        s.settings.wind = random.vector(10);
        add_ground(s);
        DeformableSpec spec = draw % 4 == 0   ? sheet({3, 3}, {0.6, 0.6})
                              : draw % 4 == 1 ? balloon(0.3, 2)
                              : draw % 4 == 2 ? block({0.2, 0.2, 0.2}, {2, 2, 2})
                                              : rope({-0.5, 0, 0}, {0.5, 0, 0}, 6);
        const Rotation turn = random.rotation();
        for (Vector& p : spec.points) p = turn * p + Vector(0, 0.7, 0);
        spec.mass = random.number(0.01, 2), spec.radius = 0.02;
        spec.elasticity.youngs_modulus = std::pow(10, random.number(3, 6));
        spec.tearing_strain = draw < 8 ? 1e-6 : random.number(0.01, 0.3);
        add_soft(s, std::move(spec));
        add_body(s, box(0.2, 0.2, 0.2), {0.03, 1.5, 0.05}).mass = 20;
        SCOPED_TRACE(draw);
        Simulation simulation(s, colliders(), "reference");
        expect_bounded(simulation, 3, 10, 200);
        const Deformable& d = simulation.world().deformables[0];
        all += d.spec.segments.empty() && d.spec.triangles.empty() && d.spec.tetrahedra.empty();
    }
    EXPECT_GE(all, 4u) << "so often nothing is left";
}

/// Cubes that fall on each other at default settings, however their cells are cut: each is pressed
/// by a tenth at most, and comes out as long as it was.
TEST_P(SoftExtremes, CubesOnEachOtherStayWhole) {
    for (const reader::CellCut cut : {reader::CellCut::five, reader::CellCut::body_centered})
        for (unsigned seed = 1; seed <= 3; ++seed) {
            Random random(seed);
            Scene s;
            s.settings.precision = GetParam();
            s.materials[0].friction = 0.8;
            add_ground(s);
            for (int i = 0; i < 3; ++i) {
                const Vector at(random.number(-0.02, 0.02), 0.23 + 0.44 * i,
                                random.number(-0.02, 0.02));
                DeformableSpec& cube = add_soft(s, block({0.2, 0.2, 0.2}, {5, 5, 5}, at, cut));
                cube.elasticity.youngs_modulus = 1e5, cube.elasticity.poissons_ratio = 0.4;
                cube.elasticity.damping = 0.005;
            }
            Simulation simulation(s, colliders(), "reference");
            run_for(simulation, 6);  // two of them roll
            const World& world = simulation.world();
            for (const Deformable& d : world.deformables) {
                double low = 1e9, high = -1e9;
                for (std::uint32_t i = d.first; i < d.first + d.count; ++i) {
                    low = std::min(low, world.particles.position[i].y());
                    high = std::max(high, world.particles.position[i].y());
                }
                EXPECT_NEAR(high - low, 0.4, 0.04) << "seed " << seed;
            }
        }
}

}  // namespace
}  // namespace plumb::test
