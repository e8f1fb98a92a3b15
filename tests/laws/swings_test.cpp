// SPDX-License-Identifier: MIT
/// What swings on joints: chains under any load, trees of all kinds, and pendulums over a minute.
/// The step is drawn, or one of the two usual ones: 10 ms with 5 + 5 iterations, and 1/60 s with 20
/// substeps of 1 + 1.
#include "support/swings.h"
#include "support/draw_settings.h"
#include "support/pendulum.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace plumb::test {
namespace {

class Swings : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, Swings, each_precision(), precision_name);

constexpr std::uint32_t kSubsteps[] = {1, 2, 3, 4, 5, 8, 10, 20, 40};

Rotation hinge_across_the_plane() { return rotation_between(Vector::UnitX(), Vector::UnitZ()); }

/// Rods of 1 kg from the origin on in one line, `angle` from the vertical; the last carries a load.
Scene chain(Precision precision, std::uint32_t links, double length, double angle, double load) {
    Scene s = still_scene(precision);
    s.settings.joints = JointMethod::tree;
    const Vector along(std::sin(angle), -std::cos(angle), 0);
    const Rotation turn = rotation_between(-Vector::UnitY(), along);
    for (std::uint32_t i = 0; i <= links; ++i) {
        const bool is_load = i == links;
        BodySpec& body = is_load ? add_body(s, sphere(0.2 * length), along * length * links)
                                 : add_body(s, box(0.05 * length, 0.5 * length, 0.05 * length),
                                            along * length * (i + 0.5));
        body.mass = is_load ? load : 1;
        body.placement.rotation = turn;
        JointSpec joint;
        if (is_load) joint.kind = JointKind::fixed;
        joint.body_a = i, joint.body_b = i > 0 ? i - 1 : kNoIndex;
        joint.anchor = along * length * i;
        s.joints.push_back(joint);
    }
    return s;
}

/// Period of a small swing if the chain were stiff: 2π √(I / (g Σ m r)) [s].
double period_as_one(const World& world) {
    double inertia = 0, moment = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
        const double r = world.bodies.position[i].norm(), m = world.bodies.mass[i];
        inertia += m * r * r + world.bodies.inertia[i].maxCoeff();
        moment += m * r;
    }
    return 2 * std::numbers::pi * std::sqrt(inertia / (9.81 * moment));
}

/// A chain that bears far more than its weight swings as one, whatever the load and the substeps.
TEST_P(Swings, ALoadedChainSwingsAsOneBody) {
    Random random(7);
    for (int draw = 0; draw < 40; ++draw) {
        const std::uint32_t links = 2 + random.below(draw % 8 == 0 ? 99 : 20);
        const double length = random.number(0.05, 0.3), angle = random.number(5, 60) / 57.29578;
        const double load = std::pow(10, random.number(std::log10(40.0 * links), 5));
        Scene s = chain(GetParam(), links, length, angle, load);
        s.settings.substeps = kSubsteps[random.below(9)];
        s.settings.dt = random.number(0.002, 0.01);
        s.settings.position_iterations = 1 + random.below(20);
        SCOPED_TRACE(testing::Message()
                     << links << " links of " << length << " m under " << load << ", " << angle
                     << " rad, " << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), "reference");
        const World& world = simulation.world();
        const double exact = period_as_one(world) * lengthening(angle);
        PeriodWatch watch;
        double widest = 0;
        while (simulation.time() < 3.2 * exact) {
            const StepReport report = simulation.step();
            ASSERT_EQ(report.unsolved_trees, 0u) << "open by " << report.tree_error;
            for (const double error : joint_errors(world)) widest = std::max(widest, error);
            watch.see(simulation.time(), s.settings.dt, world.bodies.position[links].x());
        }
        EXPECT_NEAR(watch.period() / exact, 1, 0.005);
        EXPECT_LT(widest, 1e-5 * std::max(1.0, links * length));
    }
}

/// A tree of up to twelve bodies with loads, limits and motors, hung up askew.
Scene random_tree(Precision precision, Random& random) {
    constexpr JointKind kKinds[] = {JointKind::ball, JointKind::hinge, JointKind::universal,
                                    JointKind::slider};
    Scene s = still_scene(precision);
    s.settings.joints = JointMethod::tree;
    const std::uint32_t count = 2 + random.below(11);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t parent = i > 0 ? random.below(i) : kNoIndex;
        const Vector from = i > 0 ? s.bodies[parent].placement.position : Vector::Zero();
        const Vector to =
            from + Vector(random.number(-0.15, 0.15), -0.2, 0.1 * random.vector().z());
        const bool loaded = i + 1 == count || random.below(4) == 0;
        BodySpec& body = add_body(s, box(0.02, 0.08, 0.03), to);
        body.mass = loaded ? std::pow(10, random.number(0, 5)) : 1;
        body.angular_velocity = random.vector(0.3);
        JointSpec joint;
        joint.kind = kKinds[random.below(4)];
        joint.body_a = i, joint.body_b = parent;
        joint.anchor = 0.5 * (from + to);
        joint.frame = random.rotation();
        const std::uint32_t axis = joint.kind == JointKind::slider ? kAlongX : kTurnX;
        JointAxisSpec& free = joint.axes[axis];
        if (joint.kind == JointKind::slider)  // what slides without an end falls without one
            free.lower = -0.05, free.upper = 0.05;
        else if (joint.kind != JointKind::ball && random.below(3) == 0)
            free.lower = -0.5, free.upper = 0.5;
        if (joint.kind == JointKind::hinge && random.below(3) == 0) {
            free.motor.mode = MotorMode::velocity;
            free.motor.target = random.number(-1, 1), free.motor.greatest = 0.5;
        }
        s.joints.push_back(joint);
    }
    return s;
}

/// No joint comes apart or passes its limits by more than 10 µm, unless its step says so.
TEST_P(Swings, RandomTreesStayTogetherOrSaySo) {
    Random random(11);
    int unsolved = 0, open = 0;
    for (int draw = 0; draw < 1000; ++draw) {
        Scene s = random_tree(GetParam(), random);
        s.settings.substeps = kSubsteps[random.below(9)];
        s.settings.dt = random.number(0.002, 0.01);
        SCOPED_TRACE(testing::Message()
                     << "tree " << draw << ", " << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), "reference");
        double told = 0, widest = 0;
        for (int i = 0; i < 60; ++i) {
            const StepReport report = simulation.step();
            ASSERT_TRUE(report.finite);
            told = std::max(told, report.tree_error);
            widest = std::max(widest, widest_joint(simulation.world()));
        }
        unsolved += told > 0;
        open += widest > 1e-5;
        EXPECT_TRUE(widest < 1e-5 || told > 0) << "open by " << widest << " without a word";
    }
    EXPECT_LE(unsolved, 4) << "of 1000";
    EXPECT_EQ(open, 0) << "of 1000";
}

/// A tree of up to eight bodies on cones and twists, thrown about.
Scene tree_on_cones(Precision precision, Random& random) {
    Scene s = still_scene(precision);
    s.settings.joints = JointMethod::tree;
    const std::uint32_t count = 1 + random.below(8);
    const double scale = std::pow(10, random.number(-0.7, 0.7));
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t parent = i > 0 ? random.below(i) : kNoIndex;
        const Vector from = i > 0 ? s.bodies[parent].placement.position : Vector::Zero();
        const Vector to = from + scale * Vector(random.number(-0.15, 0.15), -0.2, 0.05);
        BodySpec& body = add_body(s, box(0.02 * scale, 0.08 * scale, 0.03 * scale), to);
        body.mass = random.below(3) == 0 ? std::pow(10, random.number(0, 2)) : 1;
        body.angular_velocity = random.vector(random.number(0, 10) / std::sqrt(scale));
        JointSpec joint;
        joint.kind = JointKind::cone_twist;
        joint.body_a = i, joint.body_b = parent;
        joint.anchor = 0.5 * (from + to), joint.frame = random.rotation();
        joint.axes[kTurnX].lower = -random.number(0.05, 1.2);
        joint.axes[kTurnX].upper = random.number(0.05, 1.2);
        joint.axes[kTurnY].lower = 0, joint.axes[kTurnY].upper = random.number(0.05, 2);
        s.joints.push_back(joint);
    }
    return s;
}

TEST_P(Swings, ConesAndTwistsHoldWhatWhirls) {
    Random random(12);
    for (int draw = 0; draw < 40; ++draw) {
        Scene s = tree_on_cones(GetParam(), random);
        if (draw % 3 == 1) use_fine_steps(s.settings);
        if (draw % 3 == 2) draw_steps(s.settings, random, {0.002, 0.02, 40, 1, 10});
        SCOPED_TRACE(testing::Message()
                     << "tree " << draw << ", " << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), "reference");
        double passed = 0;
        while (simulation.time() < 1) {
            const StepReport report = simulation.step();
            ASSERT_TRUE(report.finite);
            if (report.unsolved_trees + report.coarse_trees + report.gaping.joints > 0) continue;
            for (const double error : joint_turn_errors(simulation.world()))
                passed = std::max(passed, error);
        }
        EXPECT_LT(passed, 2e-4);
    }
}

/// A rod, two rods, or a light rod with a ball, on joints of one kind, let go at 30°.
Scene pendulum(Precision precision, JointKind kind, int bodies, bool ball) {
    constexpr double kAngle = 0.5235987756;
    Scene s = still_scene(precision);
    const Vector along(std::sin(kAngle), -std::cos(kAngle), 0);
    for (int i = 0; i < bodies; ++i) {
        BodySpec& body = add_body(s, box(0.02, 0.5, 0.02), along * (i + 0.5));
        body.placement.rotation = rotation_between(-Vector::UnitY(), along);
        if (ball) body.mass = 0.2;
    }
    if (ball) add_body(s, sphere(0.1), along).mass = 5;
    for (std::uint32_t i = 0; i < s.bodies.size(); ++i) {
        JointSpec joint;
        joint.kind = kind, joint.frame = hinge_across_the_plane();
        joint.body_a = i, joint.body_b = i > 0 ? i - 1 : kNoIndex;
        joint.anchor = along * i;
        s.joints.push_back(joint);
    }
    return s;
}

/// A ball on a rope without mass.
Scene ball_on_a_rope(Precision precision, double angle) {
    Scene s = still_scene(precision);
    const Vector at(std::sin(angle), -std::cos(angle), 0);
    add_body(s, sphere(0.1), at);
    JointSpec joint;
    joint.kind = JointKind::distance;
    joint.body_a = 0, joint.anchor = at, joint.anchor_b = Vector(Vector::Zero());
    s.joints.push_back(joint);
    return s;
}

TEST_P(Swings, KeepTheirEnergyForAMinute) {
    std::vector<std::pair<std::string, Scene>> cases;
    for (const auto& [name, kind] : {std::pair{"ball", JointKind::ball},
                                     {"hinge", JointKind::hinge},
                                     {"universal", JointKind::universal}}) {
        cases.emplace_back(std::string("a rod on a ") + name, pendulum(GetParam(), kind, 1, false));
        cases.emplace_back(std::string("two rods on a ") + name,
                           pendulum(GetParam(), kind, 2, false));
        cases.emplace_back(std::string("a ball on a rod, ") + name,
                           pendulum(GetParam(), kind, 1, true));
    }
    cases.emplace_back("a ball on a rope", ball_on_a_rope(GetParam(), 0.5));
    for (auto& [name, s] : cases)
        for (const bool fine : {false, true}) {
            if (fine) use_fine_steps(s.settings);
            const double left = energy_left(s, lowest_energy(s));
            EXPECT_GT(left, 0.99) << name << (fine ? ", fine" : ", coarse");
            EXPECT_LT(left, 1.01) << name << (fine ? ", fine" : ", coarse");
        }
}

/// One to four rods of any size and thickness, let go in line, on joints whose axes point anywhere.
/// A universal joint turns a rod that comes near its first axis about that, the faster the thinner
/// the rod is: none of theirs is thinner than 1 : 5.
void add_drawn_pendulum(Scene& s, Random& random, const Vector& at = Vector::Zero()) {
    constexpr JointKind kKinds[] = {JointKind::ball, JointKind::hinge, JointKind::universal};
    const std::uint32_t rods = 1 + random.below(4);
    const JointKind kind = kKinds[random.below(3)];
    const double length = 0.05 * std::pow(60, random.number(0, 1));
    const double thickness = random.number(kind == JointKind::universal ? 0.1 : 0.02, 0.3);
    const double angle = random.number(10, 150) / 57.29578;
    const Vector along(std::sin(angle), -std::cos(angle), 0);
    const bool in_a_plane = random.below(2) == 0;
    for (std::uint32_t i = 0; i < rods; ++i) {
        JointSpec joint;
        joint.body_a = static_cast<std::uint32_t>(s.bodies.size());
        joint.body_b = i > 0 ? joint.body_a - 1 : kNoIndex;
        BodySpec& body =
            add_body(s, box(thickness * length, 0.5 * length, 0.7 * thickness * length),
                     at + along * length * (i + 0.5));
        body.mass = 1;
        body.placement.rotation = rotation_between(-Vector::UnitY(), along);
        joint.kind = kind;
        joint.frame = in_a_plane ? hinge_across_the_plane()
                                 : rotation_between(Vector::UnitX(), random.direction());
        joint.anchor = at + along * length * i;
        s.joints.push_back(joint);
    }
}

/// At 10 ms undivided, at 1/60 s in 20 substeps, and at what is drawn.
TEST_P(Swings, OfAnySizeKeepTheirEnergy) {
    Random random(GetParam() == Precision::single ? 21 : 22);
    for (int draw = 0; draw < 45; ++draw) {
        Scene s = still_scene(GetParam());
        add_drawn_pendulum(s, random);
        if (draw % 3 == 1) use_fine_steps(s.settings);
        if (draw % 3 == 2)
            s.settings.dt = random.number(0.002, 0.02), s.settings.substeps = 1 + random.below(20);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.joints.size()
                                        << " joints of kind " << static_cast<int>(s.joints[0].kind)
                                        << ", " << s.settings.dt << " s x " << s.settings.substeps);
        EXPECT_NEAR(energy_left(s, lowest_energy(s)), 1, 0.01);
    }
}

/// Three or four rods with 10 to 100 times the weight of one at their end, let go at up to 150°.
/// They fold up, and snap as they come to a line again.
Scene loaded_rods(Precision precision, Random& random) {
    constexpr JointKind kKinds[] = {JointKind::ball, JointKind::hinge};
    Scene s = still_scene(precision);
    const JointKind kind = kKinds[random.below(2)];
    const std::uint32_t rods = 3 + random.below(2);
    const double length = random.number(0.3, 2), thickness = random.number(0.02, 0.1) * length;
    const double angle = random.number(75, 150) / 57.29578;
    const Vector along(std::sin(angle), -std::cos(angle), 0);
    for (std::uint32_t i = 0; i < rods; ++i) {
        BodySpec& body =
            add_body(s, box(thickness, 0.5 * length, 0.7 * thickness), along * length * (i + 0.5));
        body.mass = i + 1 < rods ? 1 : std::pow(10, random.number(1, 2));
        body.placement.rotation = rotation_between(-Vector::UnitY(), along);
        JointSpec joint;
        joint.kind = kind, joint.frame = hinge_across_the_plane();
        joint.body_a = i, joint.body_b = i > 0 ? i - 1 : kNoIndex;
        joint.anchor = along * length * i;
        s.joints.push_back(joint);
    }
    return s;
}

/// Or the step says that it could not follow.
TEST_P(Swings, LoadedRodsThatSnapKeepTheirEnergyOrSaySo) {
    Random random(GetParam() == Precision::single ? 41 : 42);
    int told = 0;
    for (int draw = 0; draw < 9; ++draw) {
        Scene s = loaded_rods(GetParam(), random);
        if (draw % 3 == 1) use_fine_steps(s.settings);
        if (draw % 3 == 2)
            s.settings.dt = random.number(0.002, 0.02), s.settings.substeps = 1 + random.below(20);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.joints.size() << " rods, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        std::uint32_t coarse = 0;
        const double left = energy_left(s, lowest_energy(s), &coarse);
        EXPECT_TRUE(std::abs(left - 1) < 0.01 || coarse > 0) << left << " without a word";
        told += coarse > 0;
    }
    EXPECT_LE(told, 2) << "of 9";
}

/// Two to four rods of different lengths with 10 to 300 times the weight of one at their end, let
/// go in a line at a few degrees. What joints are open by under the load is not to feed the swing.
TEST_P(Swings, SmallOnesUnderALoadKeepTheirEnergy) {
    Random random(GetParam() == Precision::single ? 43 : 44);
    for (int draw = 0; draw < 24; ++draw) {
        Scene s = still_scene(GetParam());
        if (draw % 3 == 0) use_fine_steps(s.settings);
        if (draw % 3 == 2)
            s.settings.dt = random.number(0.005, 0.02), s.settings.substeps = 4 + random.below(20);
        const std::uint32_t rods = 2 + random.below(3);
        const double angle = random.number(0.02, 0.1);
        const Vector along(std::sin(angle), -std::cos(angle), 0);
        double held = 0;
        for (std::uint32_t i = 0; i < rods; ++i) {
            const double length = random.number(0.05, 0.25);
            BodySpec& body = add_body(s, box(0.1 * length, 0.5 * length, 0.1 * length),
                                      along * (held + 0.5 * length));
            body.mass = i + 1 < rods ? random.number(0.2, 1) : std::pow(10, random.number(1, 2.5));
            body.placement.rotation = rotation_between(-Vector::UnitY(), along);
            JointSpec joint;
            joint.body_a = i, joint.body_b = i > 0 ? i - 1 : kNoIndex;
            joint.anchor = along * held;
            s.joints.push_back(joint);
            held += length;
        }
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << rods << " rods, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        EXPECT_NEAR(energy_left(s, lowest_energy(s)), 1, 0.02);
    }
}

/// What moves on when it was saved, and on other lanes and threads, does so bit for bit.
TEST_P(Swings, GoOnBitForBitInParts) {
    Random random(5);
    for (int draw = 0; draw < 6; ++draw) {
        Scene s = still_scene(GetParam());
        add_drawn_pendulum(s, random);
        add_drawn_pendulum(s, random, {20, 0, 0});
        SCOPED_TRACE(draw);
        goes_on_bit_for_bit(s, 0.7, 1.1);
    }
}

/// A rod on a hinge through its end, that turns about z at a rate [rad/s] without gravity.
Scene rotor(Precision precision, double rate) {
    Scene s = still_scene(precision);
    s.settings.gravity.setZero();
    BodySpec& body = add_body(s, box(0.02, 0.5, 0.02), {0, -0.5, 0});
    body.mass = 2;
    body.angular_velocity = {0, 0, rate};
    body.velocity = {0.5 * rate, 0, 0};
    JointSpec joint;
    joint.kind = JointKind::hinge, joint.frame = hinge_across_the_plane();
    joint.body_a = 0, joint.body_b = kNoIndex;
    joint.anchor = Vector(Vector::Zero());
    s.joints.push_back(joint);
    return s;
}

/// Also where what it turns into asks for more parts than what it was.
TEST_P(Swings, APushInOneStepGivesWhatItHas) {
    for (const double rate : {0.0, 3.0, 20.0, 60.0})
        for (const double torque : {30.0, 300.0, 1000.0}) {
            Simulation simulation(rotor(GetParam(), rate), colliders(), "reference");
            const World& world = simulation.world();
            const double inertia = world.bodies.inertia[0].maxCoeff() + 2 * 0.25;
            simulation.set_force(0, Vector::Zero(), {0, 0, torque});
            simulation.step();
            simulation.set_force(0, Vector::Zero(), Vector::Zero());
            for (int i = 0; i < 20; ++i) simulation.step();
            const double exact = rate + torque * world.settings.dt / inertia;
            EXPECT_NEAR(world.bodies.angular_velocity[0].z() / exact, 1, 0.02)
                << rate << " rad/s, " << torque << " N m";
        }
}

/// A rotor that a motor slowly makes faster, through all numbers of parts: its load is m r ω².
TEST_P(Swings, LoadsAreReadAlsoWherePartsChange) {
    Scene s = rotor(GetParam(), 2);
    JointMotor& motor = s.joints[0].axes[kTurnX].motor;
    motor.mode = MotorMode::velocity, motor.target = 80, motor.greatest = 4;
    Simulation simulation(s, colliders(), "reference");
    const World& world = simulation.world();
    const double inertia = world.bodies.inertia[0].maxCoeff() + 2 * 0.25;
    while (simulation.time() < 8) {
        simulation.step();
        const double rate = world.bodies.angular_velocity[0].norm();
        if (simulation.time() < 0.1) continue;
        const double load = simulation.joint_load(0).force.norm();
        // towards the hinge, and what the motor's torque makes of it across
        const double exact = 2 * 0.5 * std::hypot(rate * rate, motor.greatest / inertia);
        ASSERT_NEAR(load / exact, 1, 0.03) << simulation.time() << " s, " << rate << " rad/s";
    }
    EXPECT_GT(world.bodies.angular_velocity[0].norm(), 40);
}

/// What hangs by a hook that a script moves, but that stands still, divides its substeps.
TEST_P(Swings, AHookAtRestIsAsGoodAsTheWorld) {
    Scene s = still_scene(GetParam());
    BodySpec& hook = add_body(s, sphere(0.05), Vector::Zero());
    hook.motion = Motion::kinematic;
    for (std::uint32_t i = 0; i < 2; ++i) {
        add_body(s, box(0.5, 0.05, 0.05), {0.5 + i, 0, 0}).mass = 1;
        JointSpec joint;
        joint.kind = JointKind::hinge, joint.frame = hinge_across_the_plane();
        joint.body_a = i + 1, joint.body_b = i;
        joint.anchor = {1.0 * i, 0, 0};
        s.joints.push_back(joint);
    }
    s.settings.dt = 1.0 / 60;
    EXPECT_NEAR(energy_left(s, -9.81 * (0.5 + 1.5)), 1, 0.01);
}

TEST_P(Swings, HaveTheirPeriods) {
    for (const double angle : {0.1, 0.5, 1.0})
        for (const bool fine : {false, true}) {
            Scene rope = ball_on_a_rope(GetParam(), angle);
            if (fine) use_fine_steps(rope.settings);
            Simulation simulation(rope, colliders(), "reference");
            PeriodWatch watch;
            while (simulation.time() < 30) {
                simulation.step();
                watch.see(simulation.time(), rope.settings.dt,
                          simulation.world().bodies.position[0].x());
            }
            const double exact = 2 * std::numbers::pi * std::sqrt(1 / 9.81) * lengthening(angle);
            EXPECT_NEAR(watch.period() / exact, 1, 0.001) << angle << (fine ? " fine" : " coarse");
        }
}

}  // namespace
}  // namespace plumb::test
