// SPDX-License-Identifier: MIT
/// What deforms tears where it is strained too far, and nowhere else.
#include "constraints/volume.h"
#include "support/scenes.h"
#include "support/soft_scenes.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class Tearing : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, Tearing, each_precision(), precision_name);

std::uint32_t torn_in(Simulation& simulation, double seconds) {
    std::uint32_t torn = 0;
    for (const double end = simulation.time() + seconds - 1e-9; simulation.time() < end;) {
        const StepReport report = simulation.step();
        EXPECT_TRUE(report.finite);
        torn += report.torn_elements;
    }
    return torn;
}

/// A rope that hangs from the world with a ball at its end: the strain of its topmost segment is
/// (M + m') g / E A, m' the mass below. It holds where that is less than what tears it, and tears
/// there where it is more.
TEST_P(Tearing, ARopeTearsAtTheLoadOfTheFormula) {
    for (const double share : {0.9, 1.1}) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.substeps = 50;
        add_body(s, sphere(0.1), {0, -1.1, 0}).mass = 2;
        DeformableSpec& spec = add_soft(s, rope({0, 0, 0}, {0, -1, 0}, 4));
        spec.mass = 0.4, spec.thickness = 0.01, spec.mask = 0;
        spec.elasticity.youngs_modulus = 4e6, spec.elasticity.damping = 0.2;
        const double section = std::numbers::pi / 4 * 1e-4,
                     strain = (2 + 0.35) * 9.81 / (4e6 * section);
        spec.tearing_strain = strain / share;
        hold(s, 0, {0});
        add_link(s, point_of(0, 4), on_body(0, {0, -1, 0}));
        s.links.back().shortest = s.links.back().longest = 1e-6;
        Simulation simulation(s, colliders(), "reference");
        const std::uint32_t torn = torn_in(simulation, 4);
        const Deformable& d = simulation.world().deformables[0];
        std::cout << "strain " << strain << ", tears at " << spec.tearing_strain << ": " << torn
                  << " torn\n";
        if (share < 1) {
            EXPECT_EQ(torn, 0u);
        } else {
            ASSERT_EQ(d.torn, std::vector<std::uint32_t>{0}) << "the topmost bears most";
            EXPECT_LT(simulation.world().bodies.position[0].y(), -2) << "the ball fell";
        }
    }
}

/// A strip between two plates that part evenly is strained alike everywhere, and tears when their
/// distance says so: across its whole width within a few steps.
TEST_P(Tearing, AStripTearsWhenItIsPulledBeyondItsStrain) {
    Scene s;
    s.settings.precision = GetParam();
    s.settings.gravity.setZero();
    s.settings.substeps = 40, s.settings.position_iterations = 10;
    s.settings.forbid = {"contacts"};
    DeformableSpec& spec = add_soft(s, sheet({4, 4}, {0.8, 0.4}));
    spec.mass = 0.01, spec.elasticity.poissons_ratio = 0;
    spec.elasticity.youngs_modulus = 1e5, spec.elasticity.damping = 0.01;
    spec.tearing_strain = 0.2;
    std::vector<std::uint32_t> left, right;
    for (std::uint32_t row = 0; row <= 4; ++row)
        left.push_back(5 * row), right.push_back(5 * row + 4);
    BodySpec& plate = add_body(s, box(0.05, 0.05, 0.3), {0.45, 0, 0}, Motion::kinematic);
    plate.velocity = {0.04, 0, 0};
    hold(s, 0, left), hold(s, 0, right, 0);
    Simulation simulation(s, colliders(), "reference");
    while (simulation.world().deformables[0].torn.empty() && simulation.time() < 5)
        torn_in(simulation, 0.01);
    std::cout << "first torn at " << simulation.time() << " s\n";
    EXPECT_NEAR(simulation.time(), 4, 0.05) << "where 0.04 m/s have pulled 0.8 m by a fifth";
    torn_in(simulation, 0.2);
    const Deformable& d = simulation.world().deformables[0];
    EXPECT_GE(d.torn.size(), 4u) << "the tear has gone across";
    EXPECT_EQ(d.spec.triangles.size() + d.torn.size(), d.whole.triangles.size());
}

/// In a step no two elements that share a point give way.
TEST_P(Tearing, EachPointLosesOneElementAStep) {
    Scene s = shot_through_a_sheet();
    s.settings.precision = GetParam();
    Simulation shot(s, colliders(), "reference");
    std::vector<std::uint32_t> before;
    std::uint32_t most = 0;
    for (int i = 0; i < 40; ++i) {
        const StepReport report = shot.step();
        ASSERT_TRUE(report.finite);
        most = std::max(most, report.torn_elements);
        const Deformable& d = shot.world().deformables[0];
        std::vector<int> lost(d.count, 0);
        std::vector<std::uint32_t> fresh;
        std::set_difference(d.torn.begin(), d.torn.end(), before.begin(), before.end(),
                            std::back_inserter(fresh));
        EXPECT_EQ(fresh.size(), report.torn_elements);
        for (const std::uint32_t element : fresh)
            for (const std::uint32_t point : d.whole.triangles[element]) ++lost[point];
        EXPECT_LE(*std::max_element(lost.begin(), lost.end()), 1);
        before = d.torn;
    }
    EXPECT_GT(most, 1u) << "it must have torn in many places";
}

/// One of each kind, spun until it tears: momentum and angular momentum stay, those of the pieces
/// and of single points together.
TEST_P(Tearing, KeepsMomentum) {
    const auto spun = [&](DeformableSpec spec) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.gravity.setZero();
        s.settings.substeps = 4;
        s.settings.forbid = {"contacts"};
        spec.mass = 1, spec.tearing_strain = 0.08, spec.velocity = {0.5, 0, 0};
        spec.elasticity.youngs_modulus = 2e4, spec.elasticity.damping = 0.01;
        add_soft(s, std::move(spec));
        // two heavy balls fly off with two of its points
        const auto& points = s.deformables[0].points;
        for (const std::uint32_t point : {0u, static_cast<std::uint32_t>(points.size() / 2)}) {
            BodySpec& ball = add_body(s, sphere(0.05), points[point]);
            ball.mass = 1, ball.velocity = {point > 0 ? 2.0 : -2.0, 1, 0.5};
            hold(s, 0, {point}, static_cast<std::uint32_t>(s.bodies.size()) - 1);
        }
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        const Vector p = linear_momentum(world), l = angular_momentum(world);
        const std::uint32_t torn = torn_in(simulation, 2);
        const double linear = (linear_momentum(world) - p).norm() / 5,
                     angular = (angular_momentum(world) - l).norm() / 5;
        std::cout << torn << " torn; linear " << linear << ", angular " << angular << "\n";
        EXPECT_GT(torn, 0u);
        EXPECT_LT(linear, GetParam() == Precision::single ? 1e-6 : 1e-12);
        EXPECT_LT(angular, GetParam() == Precision::single ? 1e-6 : 1e-12);
    };
    spun(sheet({6, 6}, {0.6, 0.6}));
    spun(balloon(0.3, 3));
    spun(block({0.2, 0.3, 0.2}, {2, 3, 2}));
    spun(rope({-0.5, 0, 0}, {0.5, 0, 0}, 8));
}

/// A balloon that loses a triangle bursts: it keeps its volume until then, and collapses under a
/// plate after.
TEST_P(Tearing, ABalloonBursts) {
    Scene s;
    s.settings.precision = GetParam();
    s.settings.substeps = 10;
    add_ground(s);
    BodySpec& plate = add_body(s, box(0.6, 0.05, 0.6), {0, 0.72, 0});
    plate.mass = 1;
    DeformableSpec& spec = add_soft(s, balloon(0.3, 4, {0, 0.33, 0}));
    spec.thickness = 0.001, spec.mass = 0.2, spec.radius = 0.01;
    spec.elasticity.youngs_modulus = 1e6, spec.elasticity.damping = 0.01;
    spec.tearing_strain = 0.5;
    Simulation simulation(s, colliders(), "reference");
    const World& world = simulation.world();
    const auto volume = [&] {
        const Deformable& d = world.deformables[0];
        const Vector origin = world.particles.position[0];
        return volume_of(d.whole.triangles, [&](std::uint32_t i) -> Vector3d {
            return world.particles.position[i] - origin;
        });
    };
    const double start = volume();
    EXPECT_EQ(torn_in(simulation, 1), 0u);
    EXPECT_NEAR(volume() / start, 1, 0.02);
    EXPECT_EQ(world.deformables[0].spec.kind, DeformableKind::balloon);
    EXPECT_GT(world.bodies.position[1].y(), 0.4);

    s.bodies[1].velocity = {0, -12, 0}, s.bodies[1].mass = 20;
    Simulation burst(s, colliders(), "reference");
    const World& after = burst.world();
    EXPECT_GT(torn_in(burst, 1.5), 0u);
    EXPECT_EQ(after.deformables[0].spec.kind, DeformableKind::cloth);
    EXPECT_LT(after.bodies.position[1].y(), 0.25) << "nothing holds the plate up";
}

}  // namespace
}  // namespace plumb::test
