// SPDX-License-Identifier: MIT
/// Impacts of bodies that touch one another: energy, momentum, and what stays where e = 0. The step
/// is drawn, or one of the two usual ones.
#include "reader/shapes/polyhedra.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace plumb::test {
namespace {

class Impacts : public OnEveryCollider {
protected:
    /// In free space, without friction.
    Scene free_scene(double restitution) const {
        Scene s = scene();
        s.settings.gravity.setZero();
        s.materials[0].restitution = restitution, s.materials[0].friction = 0;
        return s;
    }
};
INSTANTIATE_TEST_SUITE_P(, Impacts, every_collider(), where_name);

/// The two usual steps, then drawn ones.
void choose_step(Settings& s, int draw, Random& random) {
    if (draw == 0) return;
    if (draw == 1) return use_fine_steps(s);
    s.dt = random.number(0.001, 0.02);
    s.substeps = 1 + random.below(40);
    s.velocity_iterations = 1 + random.below(10);
    s.position_iterations = 1 + random.below(10);
    if (draw % 2 == 0) s.exact_islands = 0;
}

BodySpec& ball(Scene& s, double x, double y, double speed) {
    BodySpec& body = add_body(s, sphere(0.1), {x, y, 0});
    body.velocity = {speed, 0, 0};
    return body;
}

/// One to three balls run into a row that touches.
void row(Scene& s, Random& random) {
    const std::uint32_t runners = 1 + random.below(3), rest = 2 + random.below(12);
    for (std::uint32_t i = 0; i < runners; ++i) ball(s, -0.25 - 0.2 * i, 0, 1);
    for (std::uint32_t i = 0; i < rest; ++i) ball(s, 0.2 * i, 0, 0);
}

/// A ball into a ring of balls that touch.
void ring(Scene& s, Random& random) {
    const int count = 6 + static_cast<int>(random.below(6));
    const double radius = 0.1 / std::sin(std::numbers::pi / count);
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        ball(s, radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    ball(s, -radius - 0.4, random.number(-0.1, 0.1), 2);
}

/// A ball into a triangle of balls.
void triangle(Scene& s, Random& random) {
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k <= i; ++k) ball(s, 0.2 * i * std::sqrt(0.75), 0.2 * k - 0.1 * i, 0);
    ball(s, -0.5, random.number(-0.05, 0.05), 2);
}

/// Boxes face to face, and a heap of them.
void boxes(Scene& s, Random& random) {
    const int columns = 2 + static_cast<int>(random.below(4)),
              rows = 1 + static_cast<int>(random.below(4));
    for (int i = 0; i < columns; ++i)
        for (int k = 0; k < rows; ++k) add_body(s, box(0.1, 0.1, 0.1), {0.2 * i, 0.2 * k, 0});
    ball(s, -0.4, random.number(0, 0.2 * (rows - 1) + 1e-9), 3);
}

/// Runs a scene for 0.8 s: its energy is never above 1.001 of the start, and its momentum stays.
/// Returns the share of energy that is left.
double energy_kept(const Scene& s, const std::string& collider) {
    Simulation simulation(s, colliders(), collider);
    const World& world = simulation.world();
    const double before = kinetic_energy(world);
    const Vector momentum = linear_momentum(world);
    double most = 0;
    while (simulation.time() < 0.8) {
        simulation.step();
        most = std::max(most, kinetic_energy(world));
    }
    EXPECT_LT(most, 1.001 * before);
    const double bound = s.settings.precision == Precision::single ? 1e-6 : 1e-10;
    EXPECT_LT((linear_momentum(world) - momentum).norm(), bound * momentum.norm());
    return kinetic_energy(world) / before;
}

TEST_P(Impacts, NeverAddEnergyAndKeepMomentum) {
    Random random(5);
    const std::pair<const char*, std::function<void(Scene&, Random&)>> shapes[] = {
        {"row", row}, {"ring", ring}, {"triangle", triangle}, {"boxes", boxes}};
    for (const auto& [name, add] : shapes)
        for (int draw = 0; draw < 6; ++draw) {
            Scene s = free_scene(draw % 3 == 2 ? random.number(0, 1) : 1);
            add(s, random);
            choose_step(s.settings, draw, random);
            SCOPED_TRACE(testing::Message()
                         << name << ", e " << s.materials[0].restitution << ", " << s.settings.dt
                         << " s x " << s.settings.substeps << ", draw " << draw);
            const double kept = energy_kept(s, collider());
            if (draw < 2) {
                EXPECT_GT(kept, 0.5) << "elastic impacts";
            }
        }
}

/// Rows, triangles and boxes, in which one body may be a thousand times as heavy as its neighbour:
/// what sweeps would leave of an approach is energy as soon as it has become overlap.
TEST_P(Impacts, OfUnevenMassesGainNothing) {
    Random random(16);
    const std::function<void(Scene&, Random&)> shapes[] = {row, triangle, boxes};
    for (int draw = 0; draw < 60; ++draw) {
        Scene s = free_scene(draw % 3 == 2 ? random.number(0, 1) : 1);
        if (draw % 2 == 0) s.materials[0].friction = random.number(0.1, 1.5);
        shapes[random.below(3)](s, random);
        for (BodySpec& body : s.bodies) body.mass = std::pow(1000, random.number(0, 1));
        choose_step(s.settings, draw % 5, random);
        s.settings.exact_islands = Settings{}.exact_islands;
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.bodies.size() << " bodies, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        energy_kept(s, collider());
    }
}

/// A prism of so many sides, as long as wide.
Geometry prism(int sides, double radius) {
    std::vector<Vector> corners;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        for (const double y : {-0.6 * radius, 0.6 * radius})
            corners.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
    return reader::hull_geometry(corners);
}

/// A shape within about `radius` that the collider has.
Geometry drawn_shape(Random& random, double radius, bool boxes_only) {
    const double narrow = 0.3 * radius, length = random.number(0.4, 1) * radius;
    switch (boxes_only ? 0 : random.below(4)) {
        case 0:
            return box(narrow, random.number(0.2, 1) * radius, length);
        case 1:
            return capsule(narrow, length);
        case 2:
            return cylinder(narrow, length);
        default:
            return prism(3 + static_cast<int>(random.below(14)), radius);
    }
}

/// A ball that runs into a row of touching ones, in free space.
TEST_P(Impacts, RowsKeepTheirEnergy) {
    for (const bool fine : {false, true})
        for (const int count : {2, 3, 5, 8, 12, 20, 40, 63, 80}) {
            Scene s = scene();
            s.settings.gravity.setZero();
            s.materials[0].restitution = 1;
            if (fine) use_fine_steps(s.settings);
            ball(s, -0.25, 0, 1);
            for (int i = 1; i < count; ++i) ball(s, 0.2 * i, 0, 0);
            Simulation simulation(s, colliders(), collider());
            const double before = kinetic_energy(simulation.world());
            run_for(simulation, 1.5);
            const double kept = kinetic_energy(simulation.world()) / before;
            EXPECT_GT(kept, count < 64 ? 0.999 : 0.87) << count << (fine ? ", fine" : ", coarse");
            EXPECT_LT(kept, 1.001) << count << (fine ? ", fine" : ", coarse");
        }
}

/// A ball or a cube, and the row of touching ones that it runs into, whose last one touches a wall;
/// in some direction, with drawn settings.
struct RowBeforeWall {
    Scene scene;
    double speed;
    std::string text;
};

RowBeforeWall row_before_wall(Scene s, const Geometry& shape, Random& random, int draw,
                              std::uint32_t count) {
    const double speed = random.number(1, 4);
    const Vector along = random.direction();
    const Rotation turn = Rotation::FromTwoVectors(Vector::UnitX(), along);
    for (std::uint32_t i = 0; i < count; ++i) add_body(s, shape, 0.2 * i * along);
    add_body(s, shape, -(0.2 + random.number(0.001, 0.1)) * along).velocity = speed * along;
    add_body(s, box(0.3, 1, 1), (0.2 * count + 0.2) * along, Motion::fixed);
    for (BodySpec& body : s.bodies) body.placement.rotation = turn;
    choose_step(s.settings, draw, random);
    const std::string text = "draw " + std::to_string(draw) + ", " + std::to_string(count) +
                             " bodies, " + std::to_string(s.settings.dt) + " s x " +
                             std::to_string(s.settings.substeps);
    return {std::move(s), speed, text};
}

/// With e = 1 all that ran in runs out again.
TEST_P(Impacts, RowsKeepTheirEnergyAgainstAWall) {
    Random random(8);
    for (int draw = 0; draw < 24; ++draw) {
        RowBeforeWall row =
            row_before_wall(free_scene(1), sphere(0.1), random, draw, 1 + random.below(8));
        row.scene.settings.dt = std::min(row.scene.settings.dt, 0.01);
        SCOPED_TRACE(row.text);
        Simulation simulation(row.scene, colliders(), collider());
        const World& world = simulation.world();
        const double before = kinetic_energy(world);
        run_for(simulation, 0.5);
        EXPECT_GT(kinetic_energy(world), 0.999 * before);
        EXPECT_LT(kinetic_energy(world), 1.001 * before);
    }
}

/// After 0.5 s nothing is faster than 1 % of what ran in.
void expect_to_stay(const RowBeforeWall& row, const std::string& collider) {
    SCOPED_TRACE(row.text);
    Simulation simulation(row.scene, colliders(), collider);
    run_for(simulation, 0.5);
    EXPECT_LT(fastest_point(simulation.world()), 0.01 * row.speed);
}

/// With e = 0 nothing does, however long the row, and whatever its friction.
TEST_P(Impacts, WithoutRestitutionRowsStayAtAWall) {
    Random random(9);
    for (int draw = 0; draw < 36; ++draw) {
        Scene empty = free_scene(0);
        if (draw % 3 != 0) empty.materials[0].friction = random.number(0.1, 1);
        const Geometry shape = draw % 4 < 2 ? sphere(0.1) : box(0.1, 0.1, 0.1);
        const RowBeforeWall row = row_before_wall(empty, shape, random, draw, 3 + random.below(18));
        expect_to_stay(row, collider());
    }
}

/// Nor of uneven masses in long rows.
TEST_P(Impacts, WithoutRestitutionLongUnevenRowsStayAtAWall) {
    Random random(18);
    for (int draw = 0; draw < 30; ++draw) {
        Scene empty = free_scene(0);
        if (draw % 3 != 0) empty.materials[0].friction = random.number(0.1, 1.5);
        const Geometry shape = draw % 4 < 2 ? sphere(0.1) : box(0.1, 0.1, 0.1);
        RowBeforeWall row = row_before_wall(empty, shape, random, draw % 5, 10 + random.below(34));
        row.scene.settings.exact_islands = Settings{}.exact_islands;
        if (draw % 2 == 0)
            for (BodySpec& body : row.scene.bodies) body.mass = std::pow(1000, random.number(0, 1));
        expect_to_stay(row, collider());
    }
}

/// Nor does a cube that slides into a row of cubes which stand on the ground: the places at which
/// it touched the ground before do not pull it there.
TEST_P(Impacts, WithoutRestitutionRowsOnTheGroundStay) {
    Random random(15);
    for (int draw = 0; draw < 60; ++draw) {
        Scene s = scene();
        s.materials[0].restitution = 0, s.materials[0].friction = random.number(0.1, 1);
        add_ground(s);
        const std::uint32_t count = 1 + random.below(8);
        const double speed = random.number(1, 4);
        add_body(s, box(0.1, 0.1, 0.1), {-0.2 - random.number(0.001, 0.1), 0.1, 0}).velocity = {
            speed, 0, 0};
        for (std::uint32_t i = 0; i < count; ++i)
            add_body(s, box(0.1, 0.1, 0.1), {0.2 * i, 0.1, 0});
        if (draw % 3 != 0) add_body(s, box(0.3, 1, 1), {0.2 * count + 0.2, 0, 0}, Motion::fixed);
        choose_step(s.settings, draw, random);
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", " << count << " cubes, " << speed << " m/s, "
                     << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        double back = 0;
        while (simulation.time() < 0.4) {
            simulation.step();
            for (const Vector& v : simulation.world().bodies.velocity)
                back = std::max(back, -v.x());
        }
        EXPECT_LT(back, 0.01 * speed);
    }
}

/// A body that falls on the ground from some times its radius, turning at a rate [rad/s].
Scene falling(Scene s, Random& random, const Geometry& shape, double radius, double rate) {
    s.materials[0].friction = 0;
    add_ground(s);
    BodySpec& body = add_body(s, shape, {0, random.number(3, 10) * radius, 0});
    body.placement.rotation = random.rotation();
    body.angular_velocity = rate * random.direction();
    return s;
}

/// The most energy that it has in 4 s, of that at the start. Velocities are those of half a substep
/// earlier than places.
double most_energy(const Scene& s, const std::string& collider) {
    Simulation simulation(s, colliders(), collider);
    const World& world = simulation.world();
    const double half = 0.5 * s.settings.dt / s.settings.substeps;
    const auto energy = [&] {
        return total_energy(simulation) -
               half * 9.81 * world.bodies.mass[1] * world.bodies.velocity[1].y();
    };
    const double before = energy();
    double most = before;
    while (simulation.time() < 4) {
        simulation.step();
        most = std::max(most, energy());
    }
    return most / before;
}

/// Bodies that tumble as they bounce, by up to half a radian in a step. One of a hundred gains a
/// little: what is kept from closing turns by a rate that is not quite that of its momentum.
TEST_P(Impacts, OfTumblingBodiesGainNothing) {
    constexpr int kDraws = 40;
    Random random(11);
    int gaining = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
        Scene s = scene();
        s.materials[0].restitution = draw % 3 == 2 ? random.number(0.3, 1) : 1;
        choose_step(s.settings, draw % 4, random);
        const double radius = std::exp(random.number(std::log(0.02), std::log(0.4)));
        const double fastest = std::min(0.5 / s.settings.dt, 8 * std::sqrt(9.81 / radius));
        const Geometry shape = drawn_shape(random, radius, collider() == "reference");
        s = falling(s, random, shape, radius, random.number(0.3, 1) * fastest);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", radius " << radius << " m, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        const double most = most_energy(s, collider());
        gaining += most > 1.001;
        EXPECT_LT(most, 1.01);
    }
    EXPECT_LE(gaining, 1);
}

/// Small cylinders come to tumble by more than a radian in a step of 10 ms. Where their rims come
/// to by its end is not to be foreseen then.
TEST_P(Impacts, OfCylindersThatTumbleFastGainNothing) {
    if (collider() == "reference") GTEST_SKIP() << "it has no cylinders";
    Random random(13);
    for (int draw = 0; draw < 60; ++draw) {
        Scene s = scene();
        s.materials[0].restitution = 1;
        s.settings.dt = random.number(0.008, 0.014);
        const double radius = random.number(0.02, 0.06);
        const Geometry shape =
            cylinder(random.number(0.3, 0.8) * radius, random.number(0.3, 1) * radius);
        s = falling(s, random, shape, radius, random.number(2, 30));
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", radius " << radius << " m, "
                                        << s.settings.dt << " s");
        EXPECT_LT(most_energy(s, collider()), 1.01);
    }
}

/// Bodies in free space that fly together, turn and slip; `shape()`: of the next one.
template <class Shape>
Scene flying_together(Scene s, Random& random, std::uint32_t count, Shape shape) {
    constexpr double kApart = 0.72;  // [m]
    s.settings.gravity.setZero();
    s.materials[0].friction = random.number(0, 1.2);
    for (double wide = 0.4; s.bodies.size() < count; wide *= 1.02) {
        const Vector at = wide * random.vector();
        if (std::any_of(s.bodies.begin(), s.bodies.end(), [&](const BodySpec& other) {
                return (other.placement.position - at).norm() < kApart;
            }))
            continue;
        BodySpec& body = add_body(s, shape(), at);
        body.placement.rotation = random.rotation();
        body.velocity = -1.5 * at + random.vector(0.2);
        body.angular_velocity = random.vector(3);
    }
    return s;
}

/// The greatest rise of the kinetic energy in a step of 2 s, and the most over the start, both of
/// that at the start.
struct Rise {
    double in_a_step = 0, over_start = 0;
};
Rise rise_of_energy(const Scene& s, const std::string& collider) {
    Simulation simulation(s, colliders(), collider);
    const double start = kinetic_energy(simulation.world());
    double before = start;
    Rise rise;
    while (simulation.time() < 2) {
        simulation.step();
        const double energy = kinetic_energy(simulation.world());
        rise.in_a_step = std::max(rise.in_a_step, (energy - before) / start);
        rise.over_start = std::max(rise.over_start, energy / start - 1);
        before = energy;
    }
    return rise;
}

/// Friction that turns slip about may make more energy of Newton's law of restitution than there
/// was (Kane and Levinson 1985).
TEST_P(Impacts, OfFewBodiesWithFrictionGainNothing) {
    Random random(12);
    for (int draw = 0; draw < 60; ++draw) {
        Scene s = scene();
        s.materials[0].restitution = draw % 3 == 0 ? 1 : random.number(0, 1);
        choose_step(s.settings, draw % 5, random);
        s.settings.exact_islands = Settings{}.exact_islands;
        const std::uint32_t count = 2 + random.below(7);
        s = flying_together(s, random, count,
                            [&] { return drawn_shape(random, 0.2, collider() == "reference"); });
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << count << " bodies, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        EXPECT_LT(rise_of_energy(s, collider()).in_a_step, 1e-3);
    }
}

/// A ball of a coin's radius hits the coin near its rim, in free space. The coin turns into it
/// within a step, whose contacts are those of its start. What that overlap is pushed out by is no
/// more than what the collision took.
TEST_P(Impacts, WithoutRestitutionACoinGainsNothing) {
    constexpr double kRadius = 0.0127, kHalf = 0.001, kSpeed = 0.26;  // [m], [m/s]
    Random random(14);
    for (int draw = 0; draw < 120; ++draw) {
        Scene s = scene();
        s.settings.gravity.setZero();
        s.materials[0].restitution = 0, s.materials[0].friction = 0;
        use_fine_steps(s.settings);
        if (draw % 3 == 1) s.settings.dt = 0.01;
        if (draw % 3 == 2) s.settings.dt = random.number(0.008, 0.02);
        BodySpec& ball = add_body(s, sphere(kRadius), {0.03, 0, 0});
        ball.mass = 0.02, ball.velocity = {-kSpeed, 0, 0};
        const Geometry shape =
            collider() == "reference" ? box(kRadius, kHalf, kRadius) : cylinder(kRadius, kHalf);
        BodySpec& coin = add_body(s, shape, {-0.03, random.number(0.5, 1) * kRadius, 0});
        coin.mass = 0.03, coin.velocity = {kSpeed, 0, 0};
        coin.placement.rotation =
            Rotation(Eigen::AngleAxisd(random.number(1.1, 2), Vector::UnitZ()));
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.settings.dt << " s");
        EXPECT_LT(rise_of_energy(s, collider()).over_start, 1e-3);
    }
}

/// What hits with e = 0 stays: no more than 1 % of its speed comes back.
TEST_P(Impacts, WithoutRestitutionNothingComesBack) {
    Random random(3);
    for (int draw = 0; draw < 10; ++draw) {
        Scene s = scene();
        s.materials[0].restitution = 0;
        choose_step(s.settings, draw, random);
        add_ground(s);
        const double speed = random.number(0.5, 12);
        const Geometry shape = draw % 2 == 0 ? box(0.1, 0.1, 0.1) : box(0.3, 0.05, 0.1);
        add_body(s, shape, {0, 0.15, 0}).velocity = {0, -speed, 0};
        SCOPED_TRACE(testing::Message()
                     << speed << " m/s, " << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        double fastest = 0;
        while (simulation.time() < 0.3) {
            simulation.step();
            fastest = std::max(fastest, simulation.world().bodies.velocity[1].y());
        }
        EXPECT_LT(fastest, 0.01 * speed);
    }
}

}  // namespace
}  // namespace plumb::test
