// SPDX-License-Identifier: MIT
/// Structures of loose boxes come to rest within 3 s and stay: no body moves at more than 0.1 mm/s
/// or by 0.1 mm, and the contacts carry what statics says, to 1 %. PLUMB_STRUCTURE_SECONDS says how
/// long large ones and those of drawn settings stand (12), and PLUMB_STRUCTURE_DRAWS how often
/// settings are drawn for each (1); tests/long.sh: 60 and 8.
#include "support/structures.h"
#include "support/environment.h"
#include "support/growth.h"
#include "support/scenes.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace plumb::test {
namespace {

const double kSeconds = number_from("PLUMB_STRUCTURE_SECONDS", 12);
const int kDraws = number_from("PLUMB_STRUCTURE_DRAWS", 1);

/// Force on each body by its contacts in the last substep [N].
std::vector<Vector> contact_forces(const World& world) {
    const double h = world.settings.dt / world.settings.substeps;
    std::vector<Vector> force(world.bodies.size(), Vector::Zero());
    const ContactTable& c = world.contacts;
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Vector push =
            (c.memory[i].normal_impulse * to_eigen(c.found[i].normal) +
             c.memory[i].friction_impulse) /
            h;
        force[c.found[i].a] += push;
        force[c.found[i].b] -= push;
    }
    return force;
}

/// What crosses a level upwards [N]: the contacts between bodies whose centres lie on either side.
double carried_at(const World& world, double level) {
    const double h = world.settings.dt / world.settings.substeps;
    const ContactTable& c = world.contacts;
    double sum = 0;
    for (std::size_t i = 0; i < c.found.size(); ++i) {
        const Contact& contact = c.found[i];
        const auto above = [&](std::uint32_t body) {
            return world.bodies.motion[body] == Motion::dynamic &&
                   world.bodies.position[body].y() > level;
        };
        if (above(contact.a) == above(contact.b)) continue;
        const double push = c.memory[i].normal_impulse * contact.normal.y +
                            c.memory[i].friction_impulse.y();
        sum += (above(contact.a) ? push : -push) / h;
    }
    return sum;
}

/// Across every level between two bodies, contacts carry the weight above it; and every body's
/// contacts carry that body.
void expect_statics(const World& world) {
    const Bodies& b = world.bodies;
    std::vector<double> heights{0};
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] != Motion::dynamic) continue;
        heights.push_back(b.position[i].y());
    }
    std::sort(heights.begin(), heights.end());
    for (std::size_t k = 1; k < heights.size(); ++k) {
        if (heights[k] - heights[k - 1] < 1e-3) continue;
        const double level = 0.5 * (heights[k] + heights[k - 1]);
        double weight = 0;
        for (std::size_t i = 0; i < b.size(); ++i)
            if (b.motion[i] == Motion::dynamic && b.position[i].y() > level)
                weight += b.mass[i] * kGravity;
        EXPECT_NEAR(carried_at(world, level), weight, 0.01 * weight) << "at " << level << " m";
    }
    const std::vector<Vector> force = contact_forces(world);
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b.motion[i] != Motion::dynamic) continue;
        const double weight = b.mass[i] * kGravity;
        EXPECT_LT((force[i] - Vector(0, weight, 0)).norm(), 0.01 * weight) << "body " << i;
    }
}

void expect_rests(const Scene& empty, const std::string& collider, const Structure& structure,
                  double seconds, const std::string& name) {
    SCOPED_TRACE(name);
    Scene s = empty;
    add_ground(s);
    add_structure(s, structure);
    Simulation simulation(s, colliders(), collider);
    expect_still(motions_between(simulation, 3, seconds));
    expect_statics(simulation.world());
}

const std::map<std::string, Structure>& small_structures() {
    static const std::map<std::string, Structure> all = [] {
        std::map<std::string, Structure> m;
        for (int n : {2, 3, 4, 6, 10, 20})
            m["tower of " + std::to_string(n) + " cubes"] = tower(n, {0.5, 0.5, 0.5});
        m["tower of 12 small cubes"] = tower(12, {0.05, 0.05, 0.05});
        m["tower of 20 slabs"] = tower(20, {0.5, 0.1, 0.5});
        m["tower of 8 beams"] = tower(8, {1, 0.1, 0.2});
        m["tower of 12 mixed boxes"] = mixed_tower(12, 5);
        m["tower of 20 mixed boxes"] = mixed_tower(20, 9);
        m["pyramid of 2 rows"] = pyramid(2, {0.5, 0.5, 0.5}, 0.04);
        m["pyramid of 5 touching rows"] = pyramid(5, {0.3, 0.2, 0.3}, 0);
        m["table"] = table();
        m["gate"] = gate(1);
        m["gates of two storeys"] = gate(2);
        m["gates of six storeys"] = gate(6);
        return m;
    }();
    return all;
}
const std::map<std::string, Structure>& large_structures() {
    static const std::map<std::string, Structure> all{
        {"pyramid of 8 rows", pyramid(8, {0.5, 0.5, 0.5}, 0.04)},
        {"pyramid of 12 rows", pyramid(12, {0.2, 0.1, 0.2}, 0.01)},
        {"wall of 44 bricks", wall(6, 7, {0.2, 0.1, 0.1}, 0.002)},
        {"wall of 142 bricks", wall(13, 10, {0.2, 0.1, 0.1}, 0)},
    };
    return all;
}

class Structures : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Structures, every_collider(), where_name);

TEST_P(Structures, RestAtDefaultSettings) {
    for (const auto& [name, structure] : small_structures()) {
        expect_rests(scene(), collider(), structure, 60, name);
        expect_rests(scene(), collider(), unevenly(structure, 1e-3, 3), 60, name + ", 1 mm off");
    }
}

TEST_P(Structures, LargeOnesRestAtDefaultSettings) {
    for (const auto& [name, structure] : large_structures()) {
        expect_rests(scene(), collider(), structure, kSeconds, name);
        expect_rests(scene(), collider(), unevenly(structure, 1e-3, 4), kSeconds,
                     name + ", 1 mm off");
    }
}

TEST_P(Structures, CratesThatFallRest) {
    expect_rests(scene(), collider(), crates(), 60, "crates");
}

/// Steps, substeps, iterations, friction and unevenness drawn at random.
TEST_P(Structures, RestAtDrawnSettings) {
    unsigned seed = 0;
    for (int draw = 0; draw < kDraws; ++draw)
        for (const auto& [name, structure] : small_structures()) {
            Random random(++seed * 7 + 1);
            Scene s = scene();
            s.settings.dt = random.number(0.002, 0.02);
            s.settings.substeps = 1 + random.below(6);
            s.settings.velocity_iterations = 3 + random.below(20);
            s.settings.position_iterations = 3 + random.below(20);
            s.materials[0].friction = random.number(0.3, 1);
            s.materials[0].restitution = random.below(2) ? random.number(0, 0.8) : 0;
            std::ostringstream drawn;
            drawn << name << ", " << s.settings.dt << " s, " << s.settings.substeps << " x ("
                  << s.settings.velocity_iterations << " + " << s.settings.position_iterations
                  << "), friction " << s.materials[0].friction << ", restitution "
                  << s.materials[0].restitution;
            expect_rests(s, collider(), unevenly(structure, random.number(0, 2e-3), seed), kSeconds,
                         drawn.str());
        }
}

/// Twenty cubes, the topmost a thousand times heavier, at default settings and without shock
/// propagation: a straight tower and one laid unevenly.
TEST_P(Structures, ATowerCarriesATopAThousandTimesHeavier) {
    for (double off : {0.0, 1e-3}) {
        Scene s = scene();
        add_ground(s);
        add_structure(s, unevenly(tower(20, {0.5, 0.5, 0.5}), off, 3));
        s.bodies.back().mass = 1e6;
        Simulation simulation(s, colliders(), collider());
        expect_still(motions_between(simulation, 3, 20));
        expect_statics(simulation.world());
    }
}

/// Two stacks meet in free space, and keep their momentum.
TEST_P(Structures, IslandsKeepMomentum) {
    Scene s = scene();
    s.settings.gravity.setZero();
    s.materials[0].restitution = 0.3;
    add_structure(s, unevenly(tower(3, {0.2, 0.2, 0.2}), 0.05, 5));
    add_structure(s, unevenly(tower(3, {0.2, 0.2, 0.2}), 0.05, 6));
    for (int i = 3; i < 6; ++i) {
        s.bodies[i].placement.position += Vector(0.9, 0.1, 0.05);
        s.bodies[i].velocity = {-2, 0, 0.1};
    }
    Simulation simulation(s, colliders(), collider());
    const Vector linear = linear_momentum(simulation.world()),
                 angular = angular_momentum(simulation.world());
    run_for(simulation, 1);
    // arms are those of the start of the step, so that the moment of what moves is kept to its
    // motion
    const double rounding = s.settings.precision == Precision::single ? 1e-6 : 1e-9;
    EXPECT_LT((linear_momentum(simulation.world()) - linear).norm(), rounding * linear.norm());
    EXPECT_LT((angular_momentum(simulation.world()) - angular).norm(), 1e-5 * angular.norm());
}

/// A cube on a slope at 0.95 of its friction, an hour.
TEST_P(Structures, ACubeOnASteepSlopeStaysForAnHour) {
    Scene s = scene();
    s.materials[0].friction = 0.5;
    const double angle = std::atan(0.95 * 0.5);
    const Rotation turn(Eigen::AngleAxisd(angle, Vector::UnitZ()));
    add_ground(s).placement.rotation = turn;
    BodySpec& cube = add_body(s, box(0.2, 0.2, 0.2), turn * Vector(0, 0.2, 0));
    cube.placement.rotation = turn;
    Simulation simulation(s, colliders(), collider());
    run_for(simulation, 3);
    const Vector start = simulation.world().bodies.position[1];
    run_for(simulation, 3600);
    EXPECT_LT((simulation.world().bodies.position[1] - start).norm(), 1e-3);
}

/// No disturbance of what rests grows, at any iterations, substeps and step (towers of two, three
/// and six cubes, and a table): what is left after 200 substeps is not half as much again after
/// 400. A mode that grows by a hundredth a substep is sevenfold by then.
TEST_P(Structures, NoDisturbanceGrows) {
    const std::map<std::string, Structure> structures{{"2 cubes", tower(2, {0.5, 0.5, 0.5})},
                                                      {"3 cubes", tower(3, {0.5, 0.5, 0.5})},
                                                      {"6 cubes", tower(6, {0.5, 0.5, 0.5})},
                                                      {"table", table()}};
    Random random(1);
    for (const auto& [name, structure] : structures)
        for (double dt : {0.001, 0.02})
            for (std::uint32_t substeps : {1u, 5u, 40u}) {
                Settings settings = scene().settings;
                settings.dt = dt, settings.substeps = substeps;
                settings.velocity_iterations = 1 + random.below(50);
                settings.position_iterations = 1 + random.below(50);
                const int steps = static_cast<int>(200 / substeps);
                EXPECT_LE(std::pow(growth(structure, settings, colliders(), collider(),
                                          static_cast<int>(40 / substeps) + 5, steps),
                                   steps),
                          1.5)
                    << name << ", " << dt << " s, " << substeps << " x ("
                    << settings.velocity_iterations << " + " << settings.position_iterations << ")";
            }
}

/// Ten dice of 15 mm at steps of 10 ms, in which gravity makes more speed than their size suggests.
TEST_P(Structures, SmallDiceStand) {
    expect_rests(scene(), collider(), tower(10, {0.0075, 0.0075, 0.0075}), 10, "dice");
}

/// A kinematic ball at 30 m/s without gravity hits a row of three cubes that rest: they fly off
/// ahead of it, and it does not sink in.
TEST_P(Structures, WhatMovesByItselfStrikesAtItsOwnSpeed) {
    Scene s = scene();
    s.settings.gravity.setZero();
    for (int i = 0; i < 3; ++i) add_body(s, box(0.5, 0.5, 0.5), {1.0 * i, 0, 0});
    add_body(s, box(0.5, 0.5, 0.5), {-1.55, 0, 0}, Motion::kinematic).velocity = {30, 0, 0};
    Simulation simulation(s, colliders(), collider());
    run_for(simulation, 0.5);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_GT(simulation.world().bodies.velocity[i].x(), 29) << "cube " << i;
    for (double depth : penetrations(simulation.world())) EXPECT_LT(depth, 0.02);
}

/// What is required cannot make two stages solve the same contacts.
TEST_P(Structures, ShockPropagationGoesBeforeExactIslands) {
    Scene s = scene();
    s.settings.require = {"exact_islands", "shock_propagation"};
    add_ground(s);
    add_structure(s, tower(5, {0.5, 0.5, 0.5}));
    Simulation simulation(s, colliders(), collider());
    EXPECT_FALSE(simulation.plan().runs(Effect::exact_islands));
    EXPECT_EQ(simulation.plan().warnings.size(), 1u);
    run_for(simulation, 1);
}

/// A light box between heavy ones, wedged hard, goes over to iterations and back without a blow.
TEST_P(Structures, JammedLightBodiesAreNotThrown) {
    Scene s = scene();
    s.materials[0].friction = 3;
    add_ground(s);
    add_structure(s, unevenly(tower(6, {0.3, 0.2, 0.3}), 0.02, 2));
    for (std::size_t i = 1; i < s.bodies.size(); ++i) s.bodies[i].mass = i % 2 ? 1e-2 : 1e4;
    // a ball that falls on top stirs it up
    add_body(s, sphere(0.2), {0.05, 4, 0.02}).mass = 1e3;
    Simulation simulation(s, colliders(), collider());
    const double start = total_energy(simulation);
    for (int i = 0; i < 500; ++i) {
        simulation.step();
        ASSERT_LE(total_energy(simulation), start + 0.01 * std::abs(start)) << "step " << i;
    }
}

/// Of two posts, each carries half of what is above it, by symmetry.
TEST_P(Structures, PostsOfAGateShareItsWeight) {
    Scene s = scene();
    add_ground(s);
    add_structure(s, gate(2));
    Simulation simulation(s, colliders(), collider());
    run_for(simulation, 5);
    const World& world = simulation.world();
    const double h = world.settings.dt / world.settings.substeps;
    double whole = 0;
    for (double mass : world.bodies.mass) whole += mass * kGravity;
    std::vector<double> ground(world.bodies.size(), 0);
    const ContactTable& c = world.contacts;
    for (std::size_t i = 0; i < c.found.size(); ++i)
        if (c.found[i].a == 0)
            ground[c.found[i].b] += c.memory[i].normal_impulse / h;
    EXPECT_NEAR(ground[1], 0.5 * whole, 0.01 * whole);
    EXPECT_NEAR(ground[2], 0.5 * whole, 0.01 * whole);
}

}  // namespace
}  // namespace plumb::test
