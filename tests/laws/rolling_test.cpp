// SPDX-License-Identifier: MIT
/// What rolls, wobbles and falls over on fixed ground gains no energy at any step, keeps what
/// nothing takes, and comes to rest where something does.
#include "study/steady_circle.h"
#include "support/random.h"
#include "support/scenes.h"

#include <functional>
#include <vector>

namespace plumb::test {
namespace {

using study::SteadyCircle;

constexpr double kDegree = std::numbers::pi / 180;

/// A prism of n sides around y.
Geometry prism(std::uint32_t n, double radius, double half_height) {
    Geometry g;
    g.kind = ShapeKind::hull;
    std::vector<std::uint32_t> bottom, top;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        for (const double y : {-half_height, half_height})
            g.vertices.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
        g.faces.push_back({a, a + 1, b + 1, b});
        bottom.push_back(a);
        top.push_back(2 * (n - 1 - i) + 1);
    }
    g.faces.push_back(bottom);
    g.faces.push_back(top);
    return g;
}

/// A round body around its y axis, and how it starts.
struct Start {
    std::string name;
    Geometry geometry;
    double radius, half_height;
    double tilt;                ///< of the axis from upright [rad]
    double about_axis;          ///< [rad/s]
    double about_upright;       ///< [rad/s]
    bool ring = false;          ///< all mass at the radius
    double rests_at = 0;        ///< least height of the centre of mass over the ground [m]
    double centre_of_mass = 0;  ///< along the axis [m]
};

Start cylinder(const std::string& name, double radius, double half_height, double tilt,
               double about_axis, double about_upright) {
    return {name,
            round_about_y(ShapeKind::cylinder, radius, half_height),
            radius,
            half_height,
            tilt,
            about_axis,
            about_upright,
            false,
            std::min(radius, half_height)};
}

Start disk_in(const std::string& name, const SteadyCircle& circle) {
    return cylinder(name, circle.radius, circle.half_height, circle.tilt,
                    circle.rate_beside_round(), circle.round);
}

/// Ground and a body that touches it at its lowest point and does not slide there.
Scene scene_of(Scene s, const Start& start) {
    add_ground(s);
    const Rotation turn(Eigen::AngleAxisd(start.tilt, Vector::UnitX()));
    const Vector axis = turn * Vector::UnitY(), down = -Vector::UnitY();
    const Vector flat = down - down.dot(axis) * axis;
    const double end = axis.y() > 0 || start.geometry.kind == ShapeKind::cone ? -1 : 1;
    const Vector out = flat.norm() > 1e-9 ? Vector(flat.normalized()) : Vector::Zero();
    const bool ball = start.geometry.kind == ShapeKind::sphere;
    const Vector low = ball ? Vector(start.radius * down)
                            : Vector(end * start.half_height * axis + start.radius * out);
    BodySpec& body = add_body(s, start.geometry, {0, -low.y(), 0});
    body.placement.rotation = turn;
    body.angular_velocity = start.about_axis * axis + start.about_upright * Vector::UnitY();
    body.velocity = -body.angular_velocity.cross(low - start.centre_of_mass * axis);
    if (start.ring) {
        const double inertia = start.radius * start.radius;
        body.mass = 1;
        body.inertia = Vector(inertia / 2, inertia, inertia / 2);
    }
    return s;
}

double energy_above_rest(const Simulation& s, double rests_at) {
    return total_energy(s) - s.world().bodies.mass[1] * kGravity * rests_at;
}

/// How far the energy came above its start at any step, as a share of the start.
double worst_gain(Simulation& simulation, double rests_at, double seconds) {
    const double start = energy_above_rest(simulation, rests_at);
    double most = start;
    const auto steps = std::llround(seconds / simulation.world().settings.dt);
    for (long long i = 0; i < steps; ++i) {
        const StepReport report = simulation.step();
        EXPECT_TRUE(report.finite);
        EXPECT_FALSE(report.collider_failed) << report.message;
        most = std::max(most, energy_above_rest(simulation, rests_at));
    }
    return most / start - 1;
}

bool has_cylinders(const std::string& collider) { return collider != "reference"; }
bool has_cones(const std::string& collider) { return has_cylinders(collider) && collider != "ode"; }

std::vector<Start> motions(const std::string& collider) {
    std::vector<Start> all;
    for (const double speed : {3.0, 0.5}) {  // the reference has these alone
        Start ball{"ball", sphere(0.2), 0.2, 0, 90 * kDegree, speed, 1};
        ball.rests_at = 0.2;
        all.push_back(ball);
    }
    if (!has_cylinders(collider)) return all;
    all.push_back(cylinder("disk that falls over", 0.5, 0.02, 87 * kDegree, -2, 0));
    all.push_back(cylinder("disk in a circle", 0.5, 0.02, 70 * kDegree, -4, 0));
    all.push_back(cylinder("coin spun up", 0.012, 0.00085, 80 * kDegree, 0, 60));
    all.push_back(cylinder("coin that wobbles", 0.012, 0.00085, 15 * kDegree, 0, 60));
    all.push_back(cylinder("cylinder on its edge", 0.2, 0.3, 50 * kDegree, 0, 8));
    Start hoop = cylinder("hoop", 0.3, 0.03, 85 * kDegree, -4, 0.3);
    hoop.ring = true;
    all.push_back(hoop);
    Start sides = cylinder("prism of 64 sides", 0.3, 0.1, 70 * kDegree, -2, 6);
    sides.geometry = prism(64, 0.3, 0.1);
    all.push_back(sides);
    if (!has_cones(collider)) return all;
    Start cone = cylinder("cone on its edge", 0.3, 0.3, 45 * kDegree, 0, 4);
    cone.geometry.kind = ShapeKind::cone;
    cone.rests_at = 0.15;
    cone.centre_of_mass = -0.15;
    all.push_back(cone);
    return all;
}

class Rolling : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Rolling, every_collider(), where_name);

TEST_P(Rolling, GainsNothingAtCoarseAndFineSteps) {
    struct Steps {
        const char* name;
        double dt;
        std::uint32_t substeps, iterations;
    };
    for (const Steps& steps : {Steps{"10 ms", 0.01, 1, 5}, Steps{"1 ms", 0.001, 1, 5},
                               Steps{"1/60 s of 20", 1.0 / 60, 20, 1}})
        for (const Start& start : motions(collider())) {
            Scene s = scene();
            s.settings.dt = steps.dt;
            s.settings.substeps = steps.substeps;
            s.settings.velocity_iterations = s.settings.position_iterations = steps.iterations;
            Simulation simulation(scene_of(s, start), colliders(), collider());
            EXPECT_LT(worst_gain(simulation, start.rests_at, 4), 1e-3)
                << start.name << ", " << steps.name;
        }
}

TEST_P(Rolling, GainsNothingWhateverTheSettings) {
    Random random(7);
    const std::vector<Start> all = motions(collider());
    for (int draw = 0; draw < 40; ++draw) {
        Start start = all[random.below(static_cast<std::uint32_t>(all.size()))];
        start.tilt *= random.number(0.8, 1.0);
        start.about_axis *= random.number(0.2, 1.5);
        start.about_upright *= random.number(0.2, 1.5);
        Scene s = scene();
        s.settings.dt = 1e-4 * std::pow(100, random.number(0, 1));
        s.settings.substeps = 1 + random.below(40);
        s.settings.velocity_iterations = 1 + random.below(50);
        s.settings.position_iterations = 1 + random.below(50);
        s.materials[0].friction = random.number(0.1, 1);
        const double seconds = std::min(3.0, 6000 * s.settings.dt / s.settings.substeps);
        Simulation simulation(scene_of(s, start), colliders(), collider());
        EXPECT_LT(worst_gain(simulation, start.rests_at, seconds), 1e-3)
            << start.name << " leaning by " << start.tilt / kDegree << " degrees, turning by "
            << start.about_axis << " and " << start.about_upright << ", dt " << s.settings.dt
            << ", substeps " << s.settings.substeps << ", iterations "
            << s.settings.velocity_iterations << " + " << s.settings.position_iterations
            << ", friction " << s.materials[0].friction;
    }
}

/// Nothing brakes a ball or a hoop that rolls straight on.
TEST_P(Rolling, KeepsItsSpeed) {
    for (const bool hoop : {false, true}) {
        if (hoop && !has_cylinders(collider())) continue;
        for (const bool fine : {false, true}) {
            Scene s = scene();
            if (fine) use_fine_steps(s.settings);
            Start start = cylinder("hoop", 0.3, 0.05, 90 * kDegree, -5, 0);
            if (!hoop) start.geometry = sphere(0.3), start.half_height = 0;
            start.ring = hoop;
            Simulation simulation(scene_of(s, start), colliders(), collider());
            const double speed = simulation.world().bodies.velocity[1].norm();
            run_for(simulation, 10);
            EXPECT_NEAR(simulation.world().bodies.velocity[1].norm() / speed, 1, 1e-3)
                << (hoop ? "hoop" : "ball") << (fine ? ", fine" : "");
        }
    }
}

/// Contacts are kept from step to step where hardly anything moves, and do not drive what rolls.
TEST_P(Rolling, KeepsItsSpeedWhereItIsSlow) {
    for (const Geometry& shape : {sphere(0.15), round_about_y(ShapeKind::capsule, 0.15, 0.2)})
        for (const double speed : {1e-2, 3e-3, 1e-3}) {
            Scene s = scene();
            add_ground(s);
            BodySpec& body = add_body(s, shape, {0, 0.15, 0});
            body.placement.rotation = Eigen::AngleAxisd(90 * kDegree, Vector::UnitX());
            body.velocity = {speed, 0, 0};
            body.angular_velocity = {0, 0, -speed / 0.15};
            Simulation simulation(s, colliders(), collider());
            run_for(simulation, 20);
            EXPECT_NEAR(simulation.world().bodies.velocity[1].x() / speed, 1, 0.01)
                << (shape.kind == ShapeKind::sphere ? "ball" : "capsule") << " at " << speed
                << " m/s";
        }
}

/// A capsule of radius r and inertia J that lies across one of radius R > r rolls on it by an angle
/// θ, which lifts it by (R + r) (cos θ − 1) + R θ sin θ, about (R − r) θ²/2: it swings with
/// ω² = m g (R − r)/(J + m r²), and keeps its energy.
TEST_P(Rolling, ACapsuleAcrossAnotherSwingsOn) {
    const double below = 0.5, radius = 0.15;
    for (const double angle : {1e-2, 1e-3, 2e-4}) {
        Scene s = scene();
        const Rotation level(Eigen::AngleAxisd(90 * kDegree, Vector::UnitX()));
        BodySpec& support = add_body(s, round_about_y(ShapeKind::capsule, below, 0.5), {0, 0, 0});
        support.motion = Motion::kinematic;
        s.settings.forbid = {"still_ground"};  // which takes energy back
        support.placement.rotation = level;
        BodySpec& body =
            add_body(s, round_about_y(ShapeKind::capsule, radius, 0.4), {0, below + radius, 0});
        body.placement.rotation = Eigen::AngleAxisd(90 * kDegree, Vector::UnitZ());
        Simulation probe(s, colliders(), collider());
        const Bodies& made = probe.world().bodies;
        const double inertia = made.inertia[1].maxCoeff() + made.mass[1] * radius * radius;
        const double rate = std::sqrt(made.mass[1] * kGravity * (below - radius) / inertia);
        body.angular_velocity = {0, 0, angle * rate};
        body.velocity = {-angle * rate * radius, 0, 0};
        Simulation simulation(s, colliders(), collider());
        double most = 0, last = 0, crossed = 0;
        int swings = 0;
        while (simulation.time() < 40) {
            ASSERT_TRUE(simulation.step().finite);
            const double now = simulation.world().bodies.angular_velocity[1].z();
            if (simulation.time() > 35) most = std::max(most, std::abs(now));
            if (last < 0 && now >= 0) crossed = simulation.time(), ++swings;
            last = now;
        }
        EXPECT_NEAR(most / (angle * rate), 1, 0.02) << "angle " << angle;
        EXPECT_NEAR(2 * std::numbers::pi * (swings - 0.25) / crossed / rate, 1, 0.01);
    }
}

/// How fast a disk goes round and how it is tilted after 5000 steps of 1 ms, on fixed ground.
struct Rounds {
    double rate = 0, tilt = 0;  ///< [rad/s], [rad]
};
Rounds rounds_of(const Scene& scene, const std::string& collider) {
    Simulation simulation(scene, colliders(), collider);
    const auto axis = [&]() -> Vector {
        return geometry_placement(simulation.world().bodies, 1).rotation * Vector::UnitY();
    };
    double turned = 0;
    Vector before = axis();
    for (int i = 0; i < 5000; ++i) {
        EXPECT_TRUE(simulation.step().finite);
        const Vector now = axis();
        turned += std::atan2(before.cross(now).y(), before.x() * now.x() + before.z() * now.z());
        before = now;
    }
    return {turned / simulation.time(), std::acos(before.y())};
}

TEST_P(Rolling, ADiskGoesRoundInItsCircleAsTheFormulaSays) {
    if (!has_cylinders(collider())) GTEST_SKIP() << "no cylinders";
    for (const SteadyCircle& circle :
         {SteadyCircle{0.5, 0.005, 60 * kDegree, 2}, SteadyCircle{0.5, 0.005, 75 * kDegree, 1},
          SteadyCircle{0.012, 0.0005, 40 * kDegree, 30}}) {
        Scene s = scene();
        s.settings.dt = 1e-3;
        s.materials[0].friction = 5;
        const Rounds rounds = rounds_of(scene_of(s, disk_in("disk", circle)), collider());
        EXPECT_NEAR(rounds.rate / circle.round, 1, 0.01) << "radius " << circle.radius;
        EXPECT_NEAR(rounds.tilt, circle.tilt, kDegree) << "radius " << circle.radius;
    }
}

/// Small and steep ones, too, which roll on by up to a tenth of a radian in a step: their deepest
/// point alone bears, and not what will come to its place.
TEST_P(Rolling, SmallDisksGoRoundInTheirCircles) {
    if (!has_cylinders(collider())) GTEST_SKIP() << "no cylinders";
    Random random(17);
    for (int draw = 0; draw < 24; ++draw) {
        const double radius = 0.008 * std::pow(12, random.number(0, 1)),
                     half_height = radius * 0.005 * std::pow(40, random.number(0, 1)),
                     round = std::sqrt(kGravity / radius) * random.number(0.4, 2.5);
        const SteadyCircle circle{radius, half_height, random.number(25, 55) * kDegree, round};
        Scene s = scene();
        s.settings.dt = 1e-3;
        s.materials[0].friction = 20;
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", radius " << radius << " m, tilt "
                     << circle.tilt / kDegree << "°, " << circle.rate_beside_round() << " rad/s");
        const Rounds rounds = rounds_of(scene_of(s, disk_in("disk", circle)), collider());
        EXPECT_NEAR(rounds.rate / circle.round, 1, 0.01);
        EXPECT_NEAR(rounds.tilt, circle.tilt, kDegree);
    }
}

/// A wheel in a shallow groove stands on both of its rims, and rolls on upright.
TEST_P(Rolling, AWheelRollsAlongAGroove) {
    if (!has_cylinders(collider())) GTEST_SKIP() << "no cylinders";
    const double radius = 0.1, half_width = 0.01, seconds = 2;
    for (const double slope : {0.02, 0.1, 0.24})
        for (const double speed : {0.3, 1.0, 3.0}) {
            Scene s = scene();
            s.materials[0].friction = 0.8;
            Geometry groove;
            groove.kind = ShapeKind::compound;
            for (const double side : {-1.0, 1.0}) {
                const Rotation turn(Eigen::AngleAxisd(-side * slope, Vector::UnitX()));
                groove.parts.push_back({box(20, 0.5, 1), {turn * Vector(0, -0.5, side), turn}});
            }
            add_body(s, groove, Vector::Zero(), Motion::fixed);
            BodySpec& wheel = add_body(s, round_about_y(ShapeKind::cylinder, radius, half_width),
                                       {0, radius + half_width * slope + 1e-4, 0});
            wheel.placement.rotation = Eigen::AngleAxisd(90 * kDegree, Vector::UnitX());
            wheel.velocity = {speed, 0, 0}, wheel.angular_velocity = {0, 0, -speed / radius};
            SCOPED_TRACE(testing::Message() << "slope " << slope << ", " << speed << " m/s");
            Simulation simulation(s, colliders(), collider());
            const World& world = simulation.world();
            while (simulation.time() < seconds) {
                simulation.step();
                ASSERT_GT(world.bodies.position[1].y(), radius - 1e-3);
            }
            const Vector axis = geometry_placement(world.bodies, 1).rotation * Vector::UnitY();
            EXPECT_LT(std::abs(axis.y()), 0.1);
            EXPECT_NEAR(world.bodies.position[1].x() / (speed * seconds), 1, 0.05);
        }
}

/// On floors up to 2000 times as wide as the disk, too, whose contacts are cut from their faces.
TEST_P(Rolling, ItGoesRoundOnAWideFloorAsOnAPlane) {
    if (!has_cylinders(collider())) GTEST_SKIP() << "no cylinders";
    for (const double width : {3.0, 50.0, 300.0, 2000.0})
        for (const double tilt : {40.0, 50.0}) {
            const SteadyCircle circle{0.2, 0.0005, tilt * kDegree, 6};
            Scene s = scene();
            s.settings.dt = 1e-3;
            s.materials[0].friction = 5;
            s = scene_of(s, disk_in("disk", circle));
            const double half = width * circle.radius, half_height = 0.1;
            s.geometries[s.bodies[0].geometry] = box(half, half_height, half);
            s.bodies[0].placement.position.y() -= half_height;
            const Rounds rounds = rounds_of(s, collider());
            EXPECT_NEAR(rounds.rate / circle.round, 1, 0.01) << tilt << "°, width " << width;
            EXPECT_NEAR(rounds.tilt, circle.tilt, kDegree) << tilt << "°, width " << width;
        }
}

/// A coin that wobbles about its resting centre at a tilt θ has Ω² = 4 g / (r sin θ) and the energy
/// (3/2) m g r sin θ, and turns by Ω sin θ about what rolls. Rolling friction of lever ρ takes
/// ρ m g Ω sin θ cos θ from it: it lies flat after (3 r / 4 ρ) √(r/g) ∫ dθ / √(sin θ). That goes as
/// the root of the energy, so that a share s of it is left at 1 − √s of the time.
TEST_P(Rolling, ACoinThatWobblesLiesDownInItsTime) {
    if (!has_cylinders(collider())) GTEST_SKIP() << "no cylinders";
    const double radius = 0.05, lever = 1e-3, tilt = 20 * kDegree;
    double integral = 0;
    for (int i = 0; i < 2000; ++i) {
        const double root = std::sqrt(tilt) * (i + 0.5) / 2000;  // θ = root², dθ = 2 root d(root)
        integral += 2 * root / std::sqrt(std::sin(root * root)) * std::sqrt(tilt) / 2000;
    }
    const double left = 0.02,
                 whole = 0.75 * radius / lever * std::sqrt(radius / kGravity) * integral,
                 law = (1 - std::sqrt(left)) * whole;
    const SteadyCircle circle{radius, 5e-4, tilt,
                              std::sqrt(4 * kGravity / radius / std::sin(tilt))};
    Scene s = scene();
    s.settings.dt = 1e-3;
    s.materials[0].rolling_friction = lever;
    const Start start = disk_in("coin", circle);
    Simulation simulation(scene_of(s, start), colliders(), collider());
    const double energy = energy_above_rest(simulation, start.rests_at);
    double lay_down = 0;
    for (int i = 0; i < 2 * whole / s.settings.dt; ++i) {
        ASSERT_TRUE(simulation.step().finite);
        if (energy_above_rest(simulation, start.rests_at) > left * energy)
            lay_down = simulation.time();
    }
    EXPECT_GT(lay_down / law, 0.7);
    EXPECT_LT(lay_down / law, 1.1);
    EXPECT_LT(kinetic_energy(simulation.world()), 1e-12 * energy);
    EXPECT_NEAR(simulation.world().bodies.position[1].y(), circle.half_height, 1e-5);
}

/// A disk that falls over as it rolls lies flat and still in the end.
TEST_P(Rolling, WhatFallsOverComesToRestFlat) {
    if (!has_cylinders(collider())) GTEST_SKIP() << "no cylinders";
    for (const bool fine : {false, true}) {
        Scene s = scene();
        if (fine) use_fine_steps(s.settings);
        s.materials[0].rolling_friction = s.materials[0].spinning_friction = 2e-3;
        const Start start = cylinder("disk", 0.2, 0.01, 80 * kDegree, -3, 0);
        Simulation simulation(scene_of(s, start), colliders(), collider());
        const double energy = energy_above_rest(simulation, start.rests_at);
        EXPECT_LT(worst_gain(simulation, start.rests_at, 25), 1e-3);
        EXPECT_LT(kinetic_energy(simulation.world()), 1e-9 * energy) << (fine ? "fine" : "coarse");
        EXPECT_NEAR(simulation.world().bodies.position[1].y(), 0.01, 5e-5);
    }
}

}  // namespace
}  // namespace plumb::test
