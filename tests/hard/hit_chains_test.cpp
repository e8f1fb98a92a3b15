// SPDX-License-Identifier: MIT
/// Chains that swing, or fly, into what stands in their way, at settings of all kinds. Whether they
/// are solved or not, nothing gives them energy.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"
#include "ties/joint_state.h"

namespace plumb::test {
namespace {

constexpr double kDuration = 3;   // [s]
constexpr double kGained = 0.01;  // of the energy that there is
constexpr double kOpened = 0.25;  // of the reach: how far hits may open joints at the most,
constexpr double kClosed = 0.1;   // and how far they may still be open a second before the end
constexpr const char* kColliders[] = {"ode", "bullet", "fcl"};

/// Rods from the origin on along `ways`, that touch nothing of each other.
void add_rods(Scene& s, Random& random, const std::vector<Vector>& ways) {
    Vector end = Vector::Zero();
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const double length = random.number(0.1, 0.4), radius = random.number(0.1, 0.25) * length;
        const Vector half = length / 2 * ways[i];
        const std::uint32_t body = static_cast<std::uint32_t>(s.bodies.size());
        BodySpec& rod = random.below(2) == 0
                            ? add_body(s, capsule(radius / 2, length / 2 - radius / 2), end + half)
                            : add_body(s, box({radius / 2, length / 2, radius / 2}), end + half);
        rod.placement.rotation = Rotation::FromTwoVectors(Vector::UnitY(), ways[i]);
        if (i > 0) add_joint(s, JointKind::ball, body, body - 1, end);
        end += 2 * half;
    }
}

Settings drawn_settings(Random& random, int draw) {
    Settings s;
    if (draw % 3 == 1) use_fine_steps(s);
    if (draw % 3 == 2) draw_steps(s, random, {0.001, 0.017, 40, 1, 10});
    if (draw % 3 == 0) s.dt = 0.01, s.substeps = 1;
    return s;
}

/// Of all rods, the first of which hangs at the origin [m].
double reach_of(const Scene& s) {
    double reach = 0;
    for (const BodySpec& body : s.bodies)
        if (body.motion == Motion::dynamic) reach = std::max(reach, body.placement.position.norm());
    return reach;
}

/// Hangs on the world by its first rod, with a floor and a wall within its reach.
Scene hanging_chain(Random& random, const Settings& settings) {
    Scene s;
    s.settings = settings;
    s.materials[0].restitution = random.number(0, 1), s.materials[0].friction = random.number(0, 1);
    std::vector<Vector> ways;
    const std::uint32_t rods = 2 + random.below(7);
    for (std::uint32_t i = 0; i < rods; ++i) {
        const double angle = random.number(-0.5, 1.5);
        ways.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    add_rods(s, random, ways);
    add_joint(s, JointKind::ball, 0, kNoIndex, Vector::Zero());
    const double reach = reach_of(s);
    if (random.below(2) == 0)
        add_body(s, box({5, 1, 5}), {0, -1 - random.number(0.4, 0.8) * reach, 0}, Motion::fixed);
    else
        add_body(s, box({1, 5, 5}), {-1 - random.number(0.3, 0.8) * reach, 0, 0}, Motion::fixed);
    return s;
}

/// The same with joints of other kinds, and with a last rod of up to 100 kg, where others are of
/// grams.
Scene loaded_chain(Random& random, const Settings& settings) {
    Scene s = hanging_chain(random, settings);
    constexpr JointKind kinds[] = {JointKind::ball, JointKind::hinge, JointKind::universal};
    for (JointSpec& joint : s.joints) joint.kind = kinds[random.below(3)];
    s.bodies[s.bodies.size() - 2].mass = std::pow(10.0, random.number(-1, 2));
    return s;
}

/// Flies apart in free space, as far as its joints let it, and into itself.
Scene flying_chain(Random& random, const Settings& settings) {
    Scene s;
    s.settings = settings;
    s.materials[0].restitution = random.number(0, 1), s.materials[0].friction = random.number(0, 1);
    s.settings.gravity.setZero();
    std::vector<Vector> ways;
    const std::uint32_t rods = 3 + random.below(3);
    for (std::uint32_t i = 0; i < rods; ++i) ways.push_back(random.direction());
    add_rods(s, random, ways);
    for (BodySpec& rod : s.bodies) rod.velocity = random.vector(2);
    return s;
}

/// Kinetic and potential [J]; velocities are those of the middle of a substep, or of a part of one,
/// in which gravity pushes on.
double least_energy(const Simulation& s) {
    const World& w = s.world();
    const double h = w.settings.dt / w.settings.substeps;
    double pushed = 0;
    for (std::size_t i = 0; i < w.bodies.size(); ++i)
        pushed += 0.5 * h * w.bodies.mass[i] * w.settings.gravity.dot(w.bodies.velocity[i]);
    return total_energy(s) + std::min(0.0, pushed);
}

/// m g times a length of all that moves [J].
double weight_times(const World& world, double length) {
    double mass = 0;
    for (const double m : world.bodies.mass) mass += m;
    return mass * kGravity * length;
}

/// Runs it to the end, and finds the most energy on the way [J].
void run_to_the_end(Simulation& simulation, double& most) {
    while (simulation.time() < kDuration) {
        ASSERT_TRUE(simulation.step().finite) << "at " << simulation.time();
        most = std::max(most, least_energy(simulation));
    }
}

class HitChains : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, HitChains, each_precision(), precision_name);

TEST_P(HitChains, OnTheWorldGainNoEnergy) {
    Random random(11);
    for (int draw = 0; draw < 45; ++draw) {
        Scene s = hanging_chain(random, drawn_settings(random, draw));
        s.settings.precision = GetParam();
        const char* collider = kColliders[random.below(3)];
        SCOPED_TRACE(testing::Message() << "draw " << draw << " on " << collider);
        Simulation simulation(s, colliders(), collider);
        const double start = total_energy(simulation);
        const double there_is = weight_times(simulation.world(), reach_of(s));
        double most = start;
        ASSERT_NO_FATAL_FAILURE(run_to_the_end(simulation, most));
        EXPECT_LT(most - start, kGained * there_is);
    }
}

TEST_P(HitChains, StayTogether) {
    Random random(13);
    for (int draw = 0; draw < 60; ++draw) {
        Scene s = loaded_chain(random, drawn_settings(random, draw));
        s.settings.precision = GetParam();
        const char* collider = kColliders[random.below(3)];
        SCOPED_TRACE(testing::Message() << "draw " << draw << " on " << collider);
        Simulation simulation(s, colliders(), collider);
        const World& world = simulation.world();
        const double reach = reach_of(s);
        double most = 0, late = 0;
        while (simulation.time() < 2 * kDuration) {
            ASSERT_TRUE(simulation.step().finite) << "at " << simulation.time();
            for (const Joint& joint : world.joints.joints) {
                const double gap = joint_gap(world.bodies, joint);
                most = std::max(most, gap);
                if (simulation.time() > 2 * kDuration - 1) late = std::max(late, gap);
            }
        }
        EXPECT_LT(most, kOpened * reach);
        EXPECT_LT(late, kClosed * reach);
    }
}

TEST_P(HitChains, InFreeSpaceGainNoEnergy) {
    Random random(12);
    for (int draw = 0; draw < 30; ++draw) {
        Scene s = flying_chain(random, drawn_settings(random, draw));
        s.settings.precision = GetParam();
        const char* collider = kColliders[random.below(3)];
        SCOPED_TRACE(testing::Message() << "draw " << draw << " on " << collider);
        Simulation simulation(s, colliders(), collider);
        simulation.step();
        const double start = total_energy(simulation);
        double most = start;
        ASSERT_NO_FATAL_FAILURE(run_to_the_end(simulation, most));
        EXPECT_LT(most - start, kGained * start);
    }
}

}  // namespace
}  // namespace plumb::test
