// SPDX-License-Identifier: MIT
/// Joints that form trees are closed to 1e-6 m whatever hangs on them, at 1/100 s and without
/// substeps, and what is lost on the way is energy alone.
#include "schedule/joint_trees.h"
#include "math/rotation.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>

namespace plumb::test {
namespace {

class JointTrees : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, JointTrees, each_precision(), precision_name);

/// §8: a full binary tree of rods, each on a ball joint above its middle, hung up and turning.
Scene mobile(int levels, Precision precision) {
    Scene s;
    s.settings.precision = precision;
    s.settings.forbid = {"contacts"};
    Random random(7);
    std::vector<double> half;
    std::vector<Rotation> turn;
    for (int i = 0; i < (1 << levels) - 1; ++i) {
        int level = 0;
        while ((2 << level) <= i + 1) ++level;
        half.push_back(0.3 * std::pow(1.25, levels - 1 - level));
        turn.push_back(exponential_map({0, level % 2 ? std::numbers::pi / 2 : 0, 0}));
        JointSpec joint;
        joint.body_a = static_cast<std::uint32_t>(i);
        joint.anchor = Vector::Zero();
        if (i > 0) {
            const auto parent = static_cast<std::size_t>((i - 1) / 2);
            joint.body_b = static_cast<std::uint32_t>(parent);
            joint.anchor = s.bodies[parent].placement.position +
                           turn[parent] * Vector(i % 2 ? -half[parent] : half[parent], -0.25, 0);
        }
        BodySpec& body =
            add_body(s, box(half.back(), 0.05, 0.05), joint.anchor - Vector(0, 0.25, 0));
        body.placement.rotation = turn.back();
        body.angular_velocity = {0, random.number(-0.5, 0.5), 0};
        s.joints.push_back(joint);
    }
    return s;
}

double widest_gap(Simulation& simulation, double seconds) {
    double widest = 0;
    const auto steps = std::llround(seconds / simulation.world().settings.dt);
    for (long long i = 0; i < steps; ++i) {
        EXPECT_TRUE(simulation.step().finite);
        for (double e : joint_errors(simulation.world())) widest = std::max(widest, e);
        for (double e : joint_turn_errors(simulation.world())) widest = std::max(widest, e);
    }
    return widest;
}

TEST_P(JointTrees, AMobileOf127HoldsForTenSeconds) {
    Simulation simulation(mobile(7, GetParam()), colliders(), "reference");
    const double e0 = total_energy(simulation);
    EXPECT_LT(widest_gap(simulation, 10), 1e-6);
    EXPECT_LT(total_energy(simulation), e0);
    EXPECT_GT(total_energy(simulation), e0 - 0.001 * std::abs(e0));
}

TEST_P(JointTrees, AMobileOf4095HoldsAsWell) {
    Simulation simulation(mobile(12, GetParam()), colliders(), "reference");
    EXPECT_LT(widest_gap(simulation, 1), 1e-6);
}

/// Ten rods that fall from the horizontal: a whip.
/// It lashes so far that its links would hit each other.
TEST_P(JointTrees, AChainGainsNoEnergy) {
    Scene s;
    s.settings.precision = GetParam();
    s.settings.forbid = {"contacts"};
    for (std::uint32_t i = 0; i < 10; ++i) {
        add_body(s, box(0.25, 0.05, 0.05), {0.25 + 0.5 * i, 0, 0});
        JointSpec joint;
        joint.body_a = i;
        joint.body_b = i == 0 ? kNoIndex : i - 1;
        joint.anchor = {0.5 * i, 0, 0};
        s.joints.push_back(joint);
    }
    Simulation simulation(s, colliders(), "reference");
    const double e0 = total_energy(simulation),
                 weight = 10 * simulation.world().bodies.mass[0] * 9.81;
    for (int i = 0; i < 1000; ++i) {
        ASSERT_TRUE(simulation.step().finite);
        ASSERT_LT(total_energy(simulation), e0 + 0.01 * weight) << i;
        for (double e : joint_errors(simulation.world())) ASSERT_LT(e, 1e-6);
    }
}

/// Fifty links of 1 kg and a last one of 1 t, on balls or on short rods.
TEST_P(JointTrees, ALightChainCarriesAHeavyEnd) {
    for (const double rod : {0.0, 0.1}) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.forbid = {"contacts"};
        for (std::uint32_t i = 0; i < 50; ++i) {
            add_body(s, box(0.25, 0.05, 0.05), {0.25 + 0.5 * i, 0, 0}).mass = i < 49 ? 1 : 1000;
            JointSpec joint;
            joint.kind = rod > 0 ? JointKind::distance : JointKind::ball;
            joint.body_a = i;
            joint.body_b = i == 0 ? kNoIndex : i - 1;
            joint.anchor = {0.5 * i + rod, 0, 0};
            if (rod > 0) joint.anchor_b = Vector(0.5 * i - rod, 0, 0);
            s.joints.push_back(joint);
        }
        Simulation simulation(s, colliders(), "reference");
        EXPECT_LT(widest_gap(simulation, 5), 1e-6) << "rods of " << 2 * rod << " m";
    }
}

/// Bodies in free flight, linked by joints of all kinds.
TEST_P(JointTrees, KeepTheMomentumOfAFreeTree) {
    constexpr JointKind kKinds[] = {JointKind::ball,   JointKind::hinge,     JointKind::fixed,
                                    JointKind::slider, JointKind::universal, JointKind::planar};
    Scene s;
    s.settings.precision = GetParam();
    s.settings.gravity.setZero();
    s.settings.forbid = {"contacts"};
    Random random(3);
    for (std::uint32_t i = 0; i < 12; ++i) {
        BodySpec& body = add_body(s, box(0.3, 0.4, 0.5), random.vector(2));
        body.velocity = random.vector(0.2), body.angular_velocity = random.vector(0.5);
        if (i == 0) continue;
        JointSpec joint;
        joint.kind = kKinds[i % std::size(kKinds)];
        joint.body_a = i % 2 ? i : (i - 1) / 2, joint.body_b = i % 2 ? (i - 1) / 2 : i;
        joint.frame = random.rotation();
        joint.anchor = 0.5 * (s.bodies[joint.body_a].placement.position +
                              s.bodies[joint.body_b].placement.position);
        s.joints.push_back(joint);
    }
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 0.05);  // velocities that the joints bear
    const Vector p0 = linear_momentum(simulation.world()),
                 l0 = angular_momentum(simulation.world());
    EXPECT_LT(widest_gap(simulation, 5), 1e-6);
    const double rounding = GetParam() == Precision::single ? 1e-5 : 1e-9;
    EXPECT_LT((linear_momentum(simulation.world()) - p0).norm(), rounding * l0.norm());
    EXPECT_LT((angular_momentum(simulation.world()) - l0).norm(), rounding * l0.norm());
}

/// Chains fall on the ground. Each ends its steps for itself, so that it does not matter which
/// others are solved beside it: the same bits on any number of threads.
TEST_P(JointTrees, DoNotFeelEachOther) {
    Random random(11);
    for (int draw = 0; draw < 8; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        s.settings.joints = JointMethod::tree;
        s.settings.exact_islands = 0;
        s.settings.dt = random.number(0.004, 0.02);
        s.settings.substeps = 1 + random.below(4);
        add_ground(s);
        const int trees = 2 + static_cast<int>(random.below(5));
        const double speed = std::pow(10, random.number(-1, 1));
        for (int tree = 0; tree < trees; ++tree) {
            const int links = 2 + static_cast<int>(random.below(4));
            for (int i = 0; i < links; ++i) {
                const auto body = static_cast<std::uint32_t>(s.bodies.size());
                const Vector at(2.0 * tree, 2 - 0.3 * i, 0);
                BodySpec& b = add_body(s, box(0.03, 0.14, 0.02), at - Vector(0, 0.15, 0));
                b.velocity = speed * Vector(random.number(-1, 1), 0, random.number(-1, 1));
                if (i == links - 1) b.mass = std::pow(10, random.number(0, 3));
                if (i > 0)
                    add_joint(s, random.below(2) ? JointKind::hinge : JointKind::ball, body,
                              body - 1, at);
            }
        }
        std::uint64_t alone = 0;
        for (const std::uint32_t threads : {1u, 2u, 3u, 4u}) {
            s.settings.threads = threads;
            Simulation simulation(s, colliders(), "reference");
            run_for(simulation, 300 * s.settings.dt);
            const std::uint64_t hash = state_hash(simulation.world());
            if (threads == 1) alone = hash;
            EXPECT_EQ(hash, alone) << "draw " << draw << ", " << threads << " threads";
        }
    }
}

/// A square of four bars on hinges, one to the world on either side: three joints hang on a tree,
/// the last closes the loop.
TEST_P(JointTrees, ALoopIsClosedByIterationsAroundThem) {
    Scene s;
    s.settings.precision = GetParam();
    s.settings.joints = JointMethod::tree;
    s.settings.exact_islands = 0;  // which would solve the loop as a whole
    s.settings.forbid = {"contacts"};
    add_body(s, box(0.05, 0.5, 0.05), {0, 0.5, 0});
    add_body(s, box(0.5, 0.05, 0.05), {0.5, 1, 0});
    add_body(s, box(0.05, 0.5, 0.05), {1, 0.5, 0});
    const Vector anchors[] = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
    const std::uint32_t bodies[][2] = {{0, kNoIndex}, {1, 0}, {2, 1}, {2, kNoIndex}};
    for (int i = 0; i < 4; ++i) {
        JointSpec joint;
        joint.kind = JointKind::hinge;
        joint.body_a = bodies[i][0], joint.body_b = bodies[i][1];
        joint.anchor = anchors[i];
        joint.frame = exponential_map({0, -std::numbers::pi / 2, 0});
        s.joints.push_back(joint);
    }
    s.bodies[1].velocity = {1, 0, 0};
    Simulation simulation(s, colliders(), "reference");
    double lowest = 1;
    double widest = 0;
    for (int i = 0; i < 500; ++i) {
        ASSERT_TRUE(simulation.step().finite);
        const World& world = simulation.world();
        for (double e : joint_errors(world)) widest = std::max(widest, e);
        lowest = std::min(lowest, world.bodies.position[1].y());
    }
    EXPECT_LT(widest, 2e-3);
    EXPECT_LT(lowest, -0.9) << "it swings through";
}

TEST(JointTreesPlan, AutoTakesTreesAndLeavesLoops) {
    Scene s = mobile(3, Precision::single);
    const auto runs = [&](JointMethod method) {
        s.settings.joints = method;
        return make_plan(build_world(s)).runs(Effect::joint_trees);
    };
    EXPECT_TRUE(runs(JointMethod::auto_));
    EXPECT_FALSE(runs(JointMethod::iterate));
    s.joints.push_back(s.joints[0]);
    s.joints.back().body_a = 6;
    EXPECT_FALSE(runs(JointMethod::auto_)) << "one of eight closes a loop";
    EXPECT_TRUE(runs(JointMethod::tree));
    s.joints.clear();
    EXPECT_FALSE(runs(JointMethod::tree));
}

TEST(JointTreesPlan, FiguresWithoutMotorsAreIterated) {
    Scene s;
    for (std::uint32_t i = 0; i < 3; ++i) add_body(s, box(0.1, 0.1, 0.1), {0.3 * i, 0, 0});
    JointSpec hinge;
    hinge.kind = JointKind::hinge;
    for (const std::uint32_t i : {1u, 2u}) {
        hinge.body_a = i, hinge.body_b = i - 1, hinge.anchor = {0.3 * i - 0.15, 0, 0};
        s.joints.push_back(hinge);
    }
    const auto edges = [&] { return find_forest(build_world(s)).edges; };
    EXPECT_EQ(edges(), 2u) << "nothing drives it";
    s.joints[0].axes[kTurnX].upper = 0.5, s.joints[1].axes[kTurnX].friction = 1;
    EXPECT_EQ(edges(), 0u);
    s.joints[0].axes[kTurnX].motor.mode = MotorMode::position;
    EXPECT_EQ(edges(), 2u) << "a motor";
    s.joints[0].axes[kTurnX].motor.mode = MotorMode::none;
    s.bodies[0].motion = Motion::fixed;
    EXPECT_EQ(edges(), 2u) << "it is held";
}

/// One coupling to five joints and more is iterated beside their tree.
TEST(JointTreesPlan, ACouplingConcernsTheBodiesThatHangTogetherWithIt) {
    for (const int levels : {2, 3}) {
        const std::uint32_t rods = (1u << levels) - 1;
        Scene s = mobile(levels, Precision::single);
        JointSpec hinge;
        hinge.kind = JointKind::hinge;
        hinge.axes[kTurnX].lower = -0.3;
        for (const std::uint32_t body : {rods, rods + 1}) {
            add_body(s, box(0.1, 0.2, 0.3), {50.0 + body, 0, 0});
            hinge.body_a = body, hinge.anchor = {50.0 + body, 1, 0};
            s.joints.push_back(hinge);
        }
        EXPECT_EQ(find_forest(build_world(s)).edges, rods + 2)
            << "what drives a joint is part of its tree";
        CouplingSpec gear;
        gear.joint_a = rods, gear.joint_b = rods + 1;
        s.couplings.push_back(gear);
        const JointForest apart = find_forest(build_world(s));
        EXPECT_EQ(apart.edges, rods);
        EXPECT_EQ(apart.in_tree[rods], 0);
        s.joints[rods].body_b = rods - 1;  // now they hang together
        EXPECT_EQ(find_forest(build_world(s)).edges, rods + 1 >= 5 ? rods + 1 : 0);
        s.settings.joints = JointMethod::tree;
        EXPECT_EQ(find_forest(build_world(s)).edges, rods + 2);
    }
}

}  // namespace
}  // namespace plumb::test
