// SPDX-License-Identifier: MIT
/// Deformables of all kinds as one system, with what hangs on them, lies on them and presses them:
/// materials come to what their numbers say, at any settings.
#include "measure/deformation.h"
#include "measure/measure.h"
#include "support/draw_settings.h"
#include "support/soft.h"

#include <cmath>
#include <numbers>

namespace plumb::test {
namespace {

class OneSystem : public InEachPrecision {
protected:
    Scene scene() const {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.exact_deformables = 10000;
        return s;
    }
};
INSTANTIATE_TEST_SUITE_P(, OneSystem, each_precision(), precision_name);

constexpr double kGravity = 9.81;

/// A box of 50 … 5000 times a string's mass, let go at some degrees: it swings as on a rod, and
/// stretches the string by m g L / (E A).
TEST_P(OneSystem, ABoxSwingsOnAString) {
    Random random(41);
    for (int draw = 0; draw < 9; ++draw) {
        Scene s = scene();
        draw_settings(s.settings, random, draw);
        s.settings.forbid = {"contacts"};  // it hangs by its centre
        const double length = random.number(0.5, 2), angle = random.number(0.1, 0.3);
        const int segments = 10 + int(random.below(20));
        const double strain = std::pow(10, random.number(-5, -2.5));
        const Vector out(std::sin(angle), -std::cos(angle), 0);
        DeformableSpec& string = add_soft(s, rope({0, 0, 0}, length * out, segments));
        string.mass = 0.01, string.radius = 0.005, string.thickness = 0.01;
        const double mass = *string.mass * std::pow(10, random.number(1.7, 3.7));
        const double area = std::numbers::pi / 4 * 1e-4;
        string.elasticity.youngs_modulus = mass * kGravity / (area * strain);
        BodySpec& bob = add_body(s, box(0.06, 0.06, 0.06), length * out);
        bob.mass = mass;
        hold(s, 0, {0});
        hold(s, 0, {std::uint32_t(segments)}, 0);
        Simulation simulation(s, colliders(), "reference");
        const double quarter =
            std::numbers::pi / 2 * std::sqrt(length / kGravity) * (1 + angle * angle / 16);
        const World& world = simulation.world();
        double before = 1, passed = 0, longest = 0, apart = 0;
        while (simulation.time() < 2 * quarter && passed == 0) {
            ASSERT_TRUE(simulation.step().finite);
            const Vector& at = world.bodies.position[0];
            if (at.x() < 0) passed = simulation.time() - s.settings.dt * at.x() / (at.x() - before);
            before = at.x();
            longest = std::max(longest, at.norm());
            for (const double error : link_errors(world)) apart = std::max(apart, error);
        }
        std::cout << s.settings.dt << " s x " << s.settings.substeps << ", " << mass
                  << " kg: passes " << passed / quarter - 1 << " late, strain "
                  << longest / length - 1 << " of " << strain << ", apart " << apart << " m\n";
        EXPECT_NEAR(passed, quarter, 0.005 * quarter);
        // let go without a strain, it swings about what it comes to at rest, and is pulled by the
        // swing as well
        EXPECT_LT(longest / length - 1, 3 * strain + 1e-4);
        EXPECT_LT(apart, 1e-4);
    }
}

/// Ropes that are slack or taut from the corners of a sheet to what moves by a script.
TEST_P(OneSystem, ASheetHangsByRopesOnAHand) {
    Random random(43);
    for (int draw = 0; draw < 4; ++draw) {
        Scene s = scene();
        draw_settings(s.settings, random, draw);
        DeformableSpec& net = add_soft(s, sheet({8, 8}, {1, 1}));
        net.mass = 0.3, net.radius = 0.02, net.elasticity.youngs_modulus = 1e6;
        net.elasticity.damping = 0.01;
        add_body(s, box(0.5, 0.05, 0.5), {0, 1, 0}, Motion::kinematic).velocity = {0.3, 0.2, 0};
        for (const std::uint32_t corner : {0u, 8u, 72u, 80u}) {
            const double x = corner % 9 == 0 ? -0.5 : 0.5, z = corner < 9 ? -0.5 : 0.5;
            add_link(s, point_of(0, corner), on_body(0, {x, 0.95, z})).longest = 1.0;
        }
        add_body(s, box(0.15, 0.15, 0.15), {0.05, 0.2, 0.03}).mass = random.number(1, 100);
        Simulation simulation(s, colliders(), "reference");
        double apart = 0;
        while (simulation.time() < 3) {
            ASSERT_TRUE(simulation.step().finite);
            if (simulation.time() > 1)
                for (const double error : link_errors(simulation.world()))
                    apart = std::max(apart, error);
        }
        const Bodies& b = simulation.world().bodies;
        std::cout << *s.bodies[1].mass << " kg: ropes " << apart << " m too long\n";
        EXPECT_LT(apart, 1e-3);
        EXPECT_GT(b.position[1].y(), b.position[0].y() - 2) << "it fell out of the net";
    }
}

/// A stack of soft cubes under a plate comes to the same height whatever the settings, and to rest.
TEST_P(OneSystem, SoftCubesBearAPlate) {
    double height = 0;
    for (int draw = 0; draw < 3; ++draw) {
        Scene s = scene();
        Random random(47);
        draw_settings(s.settings, random, draw);
        add_ground(s);
        for (int i = 0; i < 2; ++i) {
            DeformableSpec& cube =
                add_soft(s, block({0.2, 0.2, 0.2}, {3, 3, 3}, {0.02 * i, 0.23 + 0.43 * i, 0.01}));
            cube.mass = 60, cube.radius = 0.01;
            cube.elasticity.youngs_modulus = 1e5, cube.elasticity.poissons_ratio = 0.4;
            cube.elasticity.damping = 0.1;
        }
        add_body(s, box(0.2, 0.05, 0.2), {0, 0.95, 0}).mass = 40;
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 4);
        const World& world = simulation.world();
        double fastest = 0;
        for (const Vector3d& v : world.particles.velocity) fastest = std::max(fastest, v.norm());
        const double y = world.bodies.position[1].y();
        std::cout << "plate at " << y << " m, " << world.bodies.velocity[1].norm()
                  << " m/s, points at up to " << fastest << " m/s\n";
        EXPECT_LT(world.bodies.velocity[1].norm(), 5e-3);
        EXPECT_LT(fastest, 0.02);
        EXPECT_GT(y, 0.6);
        if (draw == 0) height = y;
        EXPECT_NEAR(y, height, 0.0005);
    }
}

/// Balloons under a plank, to which they are tied, keep their volumes.
TEST_P(OneSystem, BalloonsBearAPlank) {
    Random random(53);
    for (int draw = 0; draw < 2; ++draw) {
        Scene s = scene();
        draw_settings(s.settings, random, draw);
        add_ground(s);
        add_body(s, box(0.6, 0.03, 0.35), {0, 0.64, 0}).mass = random.number(2, 10);
        for (int i = 0; i < 2; ++i) {
            // near enough to press on each other
            DeformableSpec& skin = add_soft(s, balloon(0.29, 3, {0.56 * i - 0.28, 0.305, 0}));
            skin.mass = 0.3, skin.radius = 0.01, skin.thickness = 5e-4, skin.volume_ratio = 1.05;
            skin.elasticity.youngs_modulus = 2e6, skin.elasticity.damping = 0.01;
            std::vector<std::uint32_t> top;
            for (std::uint32_t k = 0; k < skin.points.size(); ++k)
                if (skin.points[k].y() > 0.27) top.push_back(k);
            hold(s, std::uint32_t(i), top, 1);
        }
        Simulation simulation(s, colliders(), "reference");
        run_for(simulation, 1);
        const World& world = simulation.world();
        double off = 0;
        for (const double error : volume_errors(world)) off = std::max(off, std::abs(error));
        double apart = 0;
        for (const double error : link_errors(world)) apart = std::max(apart, error);
        std::cout << *s.bodies[1].mass << " kg: volume off by " << off << ", plank at "
                  << world.bodies.position[1].transpose() << ", apart " << apart << " m\n";
        ASSERT_EQ(volume_errors(world).size(), 2u);
        EXPECT_LT(off, 1e-4);
        EXPECT_LT(apart, 1e-4);
        EXPECT_GT(world.bodies.position[1].y(), 0.4);
    }
}

}  // namespace
}  // namespace plumb::test
