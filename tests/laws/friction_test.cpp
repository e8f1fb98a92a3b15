// SPDX-License-Identifier: MIT
/// Coulomb's law on slopes and on the flat. Steps: 1/60 s with 20 substeps × (1 + 1), or 0.01 s
/// with 5 + 5 iterations.
#include "support/random.h"
#include "support/scenes.h"

#include <vector>

namespace plumb::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Boxes side by side along z on one slope, each of its own friction with it.
struct Slope {
    Simulation simulation;
    std::vector<Vector> start;

    static Scene make(Scene scene, double angle, const std::vector<double>& frictions) {
        const Rotation tilt(Eigen::AngleAxisd(angle, Vector::UnitZ()));
        scene.materials[0].friction = 1;
        BodySpec& slope = add_body(scene, box(300, 1, 100), tilt * Vector(0, -1, 0), Motion::fixed);
        slope.placement.rotation = tilt;
        for (std::size_t i = 0; i < frictions.size(); ++i) {
            Material m;
            m.friction = frictions[i] * frictions[i];  // √(μ · 1) with the slope
            scene.materials.push_back(m);
            BodySpec& b =
                add_body(scene, box(0.5, 0.5, 0.5), tilt * Vector(0, 0.5, 2.0 * double(i) - 10));
            b.placement.rotation = tilt;
            b.material = static_cast<std::uint32_t>(i + 1);
        }
        return scene;
    }
    Slope(const Scene& scene, const std::string& collider)
        : simulation(scene, colliders(), collider) {
        for (const Vector& x : simulation.world().bodies.position) start.push_back(x);
    }
    double moved(std::size_t i) const {
        return (simulation.world().bodies.position[i + 1] - start[i + 1]).norm();
    }
};

class Friction : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Friction, every_collider(), where_name);

TEST_P(Friction, HoldsWhereItIsHalfADegreeMoreThanTheSlope) {
    for (bool fine : {false, true})
        for (double degrees : {5.0, 10.0, 20.0, 30.0, 40.0}) {
            Scene s = scene();
            if (fine) use_fine_steps(s.settings);
            const std::vector<double> frictions{std::tan((degrees + 0.5) * kDegree),
                                                std::tan((degrees + 3) * kDegree), 1.0};
            Slope slope(Slope::make(s, degrees * kDegree, frictions), collider());
            run_for(slope.simulation, 10);
            for (std::size_t i = 0; i < frictions.size(); ++i)
                EXPECT_LT(slope.moved(i), 1e-3) << degrees << " degrees, friction " << frictions[i]
                                                << (fine ? ", fine" : ", coarse");
        }
}

TEST_P(Friction, YieldsWhereItIsHalfADegreeLessAndSlidesByTheLaw) {
    for (double degrees : {5.0, 10.0, 20.0, 30.0, 40.0}) {
        Scene s = scene();
        use_fine_steps(s.settings);
        const double angle = degrees * kDegree, time = 2;
        const double nearly = std::tan(angle - 0.5 * kDegree);
        const std::vector<double> frictions{0.1 * std::tan(angle), 0.5 * std::tan(angle), nearly};
        Slope slope(Slope::make(s, angle, frictions), collider());
        run_for(slope.simulation, time);
        for (std::size_t i = 0; i < frictions.size(); ++i) {
            // Where friction nearly holds, a small share of it is a large share of what is left:
            // the bound is 2 % of the slide without friction then, and the block must slide.
            const double free = 0.5 * 9.81 * std::sin(angle) * time * time;
            const double law = free - 0.5 * 9.81 * frictions[i] * std::cos(angle) * time * time;
            EXPECT_NEAR(slope.moved(i), law, 0.02 * (frictions[i] == nearly ? free : law))
                << degrees << " degrees, friction " << frictions[i];
            EXPECT_GT(slope.moved(i), 0.5 * law)
                << degrees << " degrees, friction " << frictions[i];
        }
    }
}

/// v₀²/2μg for every mass. The block slides on a face; 1/60 s × 20.
TEST_P(Friction, BrakingDistanceDoesNotDependOnMass) {
    const double speed = 3, friction = 0.5, law = speed * speed / (2 * friction * 9.81);
    std::vector<double> distances;
    for (double mass : {1.0, 1e2, 1e4}) {
        Scene s = scene();
        use_fine_steps(s.settings);
        add_ground(s);
        BodySpec& b = add_body(s, box(0.5, 0.25, 0.5), {0, 0.25, 0});
        b.mass = mass;
        b.velocity = {speed, 0, 0};
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 1.5);
        distances.push_back(simulation.world().bodies.position[1].x());
        EXPECT_LT(simulation.world().bodies.velocity[1].norm(), 1e-3);
        EXPECT_NEAR(distances.back() / law, 1, 0.02) << "mass " << mass;
    }
    for (double d : distances) EXPECT_NEAR(d / distances[0], 1, 1e-3);
}

/// What comes to a stand in the middle of a step is not pulled back to where it was when it began.
TEST_P(Friction, WhatHasStoppedDoesNotGoBack) {
    Random random(21);
    for (int draw = 0; draw < 40; ++draw) {
        Scene s = scene();
        s.settings.dt = random.number(0.001, 0.02);
        s.settings.substeps = 1 + random.below(40);
        s.settings.velocity_iterations = 1 + random.below(10);
        s.settings.position_iterations = 1 + random.below(10);
        if (draw % 2 == 0) s.settings.exact_islands = 0;
        s.materials[0].friction = random.number(0.1, 1);
        add_ground(s);
        const double speed = random.number(0.2, 4);
        add_body(s, box(0.2, 0.05, 0.1), {0, 0.05, 0}).velocity = {speed, 0, 0};
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << speed << " m/s, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        double back = 0;
        while (simulation.time() < speed / (9.81 * s.materials[0].friction) + 0.2) {
            simulation.step();
            back = std::max(back, -simulation.world().bodies.velocity[1].x());
        }
        EXPECT_LT(back, 1e-3);
    }
}

/// Forbidden friction brakes nothing, whether islands are solved exactly or not.
TEST_P(Friction, BrakesNothingWhereItIsForbidden) {
    for (const std::uint32_t exact : {0u, 64u})
        for (const std::uint32_t substeps : {1u, 4u}) {
            Scene s = scene();
            s.settings.forbid = {"friction"};
            s.settings.substeps = substeps, s.settings.exact_islands = exact;
            add_ground(s);
            add_body(s, box(0.2, 0.05, 0.1), {0, 0.05, 0}).velocity = {1, 0, 0};
            Simulation simulation(s, colliders(), collider());
            run_for(simulation, 0.5);
            EXPECT_NEAR(simulation.world().bodies.velocity[1].x(), 1, 1e-6)
                << exact << ", " << substeps << " substeps";
        }
}

/// A ball that slides at first rolls at 5 v₀/7.
TEST_P(Friction, ASlidingBallComesToRoll) {
    Scene s = scene();
    use_fine_steps(s.settings);
    add_ground(s);
    BodySpec& b = add_body(s, sphere(0.2), {0, 0.2, 0});
    b.velocity = {5, 0, 0};
    Simulation simulation(s, colliders(), collider());
    const double rolls_at = 2 * 5 / (7 * 0.5 * 9.81);
    run_for(simulation, 2 * rolls_at);
    EXPECT_NEAR(simulation.world().bodies.velocity[1].x() / (5 * 5.0 / 7), 1, 0.01);
    const double later = simulation.world().bodies.velocity[1].x();
    run_for(simulation, 2);
    EXPECT_NEAR(simulation.world().bodies.velocity[1].x() / later, 1, 0.01)
        << "nothing brakes a rolling ball";
}

/// Rolling friction of lever ρ brakes a rolling ball by (5/7) ρ g / r.
TEST_P(Friction, RollingFrictionBrakesByItsLever) {
    const double speed = 2, radius = 0.2, lever = 0.01;
    Scene s = scene();
    use_fine_steps(s.settings);
    s.materials[0].rolling_friction = lever;
    add_ground(s);
    BodySpec& b = add_body(s, sphere(radius), {0, radius, 0});
    b.velocity = {speed, 0, 0};
    b.angular_velocity = {0, 0, -speed / radius};
    Simulation simulation(s, colliders(), collider());
    const double deceleration = 5.0 / 7 * lever * 9.81 / radius,
                 law = speed * speed / (2 * deceleration);
    run_for(simulation, 1.3 * speed / deceleration);
    EXPECT_NEAR(simulation.world().bodies.position[1].x() / law, 1, 0.02);
    EXPECT_LT(simulation.world().bodies.velocity[1].norm(), 1e-3);
}

/// The same whichever way it rolls: the torque is bounded by a disc across the normal, not by a
/// square.
TEST_P(Friction, RollingFrictionIsTheSameInAllDirections) {
    const double speed = 1.5, radius = 0.2, lever = 0.01;
    const double deceleration = 5.0 / 7 * lever * 9.81 / radius,
                 law = speed * speed / (2 * deceleration);
    Random random(5);
    for (int setting = 0; setting < 4; ++setting)
        for (const bool on_slabs : {false, true}) {
            Scene s = scene();
            if (setting == 1) use_fine_steps(s.settings);
            if (setting > 1) {
                s.settings.dt = random.number(0.004, 0.02);
                s.settings.substeps = 1 + random.below(10);
            }
            s.materials[0].rolling_friction = lever;
            add_ground(s);
            const std::vector<double> degrees{0, 22.5, 45, 70};
            for (std::size_t i = 0; i < degrees.size(); ++i) {
                const Vector ahead(std::cos(degrees[i] * kDegree), 0,
                                   std::sin(degrees[i] * kDegree));
                const Vector start(0, radius + (on_slabs ? 0.2 : 0), 20.0 * double(i));
                BodySpec& b = add_body(s, sphere(radius), start);
                b.velocity = speed * ahead;
                b.angular_velocity = Vector::UnitY().cross(ahead) * (speed / radius);
            }
            for (std::size_t i = 0; on_slabs && i < degrees.size(); ++i)
                add_body(s, box(8, 0.1, 8), {0, 0.1, 20.0 * double(i)}).mass = 1e6;
            Simulation simulation(s, colliders(), collider());
            run_for(simulation, 1.2 * speed / deceleration);
            for (std::size_t i = 0; i < degrees.size(); ++i) {
                const Vector ahead(std::cos(degrees[i] * kDegree), 0,
                                   std::sin(degrees[i] * kDegree));
                const Vector moved = simulation.world().bodies.position[1 + i] -
                                     Vector(0, radius + (on_slabs ? 0.2 : 0), 20.0 * double(i));
                const std::string where = std::to_string(degrees[i]) + " degrees, setting " +
                                          std::to_string(setting) + (on_slabs ? ", on a slab" : "");
                EXPECT_NEAR(moved.dot(ahead) / law, 1, 0.02) << where;
                EXPECT_LT((moved - moved.dot(ahead) * ahead).norm() / law, 0.01) << where;
                EXPECT_LT(simulation.world().bodies.velocity[1 + i].norm(), 2e-3) << where;
            }
        }
}

/// What stands on a turntable and turns with it stays where it is on it, if μ g is more than ω² r.
TEST_P(Friction, ATurntableCarriesWhatStandsOnIt) {
    const bool boxes_only = collider() == "reference";
    Random random(17);
    for (int draw = 0; draw < 12; ++draw) {
        Scene s = scene();
        s.materials[0].friction = 0.8;
        if (draw % 3 == 1) use_fine_steps(s.settings);
        if (draw % 3 == 2) s.settings.dt = random.number(0.002, 0.02);
        const double radius = random.number(0.2, 1);
        const double rate = std::sqrt(random.number(0.05, 0.6) * 0.8 * 9.81 / radius);
        const double size = random.number(0.03, 0.1), height = random.number(0.3, 0.8) * size;
        BodySpec& table = add_body(s, box(1.5, 0.05, 1.5), {0, -0.05, 0});
        table.motion = Motion::kinematic;
        table.angular_velocity = {0, rate, 0};
        const bool is_round = draw % 2 == 0 && !boxes_only;
        BodySpec& body = add_body(s, is_round ? cylinder(size, height) : box(size, height, size),
                                  {radius, height, 0});
        body.angular_velocity = {0, rate, 0};
        body.velocity = body.angular_velocity.cross(body.placement.position);
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 10);
        const Bodies& b = simulation.world().bodies;
        const Vector on_table = b.orientation[0].conjugate() * (b.position[1] - b.position[0]);
        EXPECT_LT((on_table - Vector(radius, height + 0.05, 0)).norm(), 0.005 * radius)
            << "draw " << draw << (is_round ? ", round, " : ", box, ") << rate << " rad/s at "
            << radius << " m, " << s.settings.dt << " s x " << s.settings.substeps;
    }
}

}  // namespace
}  // namespace plumb::test
