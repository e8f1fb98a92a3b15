// SPDX-License-Identifier: MIT
/// Trees of whirling bodies that were moved apart are closed by their poses: their momentum, their
/// centre of mass and their energy stay, whatever they are of.
#include "step/whirled_trees.h"
#include "support/random.h"
#include "support/scenes.h"
#include "ties/joint_state.h"
#include "world/body_momentum.h"

#include <cmath>

namespace plumb::test {
namespace {

constexpr double kSubstep = 0.01;  // [s]

/// Links of 0.3 m that branch at random, with closed joints; the first begins at the origin, where
/// it is `held` by the world or by nothing.
Scene drawn_tree(Random& random, bool held) {
    constexpr JointKind kinds[] = {JointKind::ball, JointKind::hinge, JointKind::universal,
                                   JointKind::fixed, JointKind::slider};
    Scene s;
    std::vector<Vector> ends;
    const std::uint32_t links = 2 + random.below(9);
    for (std::uint32_t i = 0; i < links; ++i) {
        const std::uint32_t on = i > 0 ? random.below(i) : kNoIndex;
        const Vector from = i > 0 ? ends[on] : Vector(Vector::Zero()), way = random.direction();
        BodySpec& link = add_body(s, box(0.02, 0.15, 0.03), from + 0.15 * way);
        link.placement.rotation = rotation_between(Vector::UnitY(), way);
        link.mass = std::pow(10, random.number(-1, 1));
        ends.push_back(from + 0.3 * way);
        if (i > 0 || held)
            add_joint(s, kinds[random.below(5)], i, on, from).frame = random.rotation();
    }
    return s;
}

/// All bodies move about, and whirl; two of them touch, as what is closed must.
void stir(World& world, Random& random, double apart) {
    Bodies& b = world.bodies;
    Contact contact{};
    contact.a = 0, contact.b = 1;
    world.contacts.found.push_back(contact);
    for (std::size_t i = 0; i < b.size(); ++i) {
        b.position[i] += random.vector(apart);
        const Vector turn = random.vector(apart);
        b.orientation[i] =
            Rotation(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * b.orientation[i];
        b.velocity[i] = random.vector(2),
        b.angular_velocity[i] = random.number(20, 60) * random.direction();
    }
}

double widest(const World& world) {
    double most = 0;
    for (const Joint& joint : world.joints.joints)
        most =
            std::max({most, joint_gap(world.bodies, joint), joint_turn_gap(world.bodies, joint)});
    return most;
}

Vector centre_of_mass(const World& world) {
    Vector moment = Vector::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        mass += world.bodies.mass[i], moment += world.bodies.mass[i] * world.bodies.position[i];
    return moment / mass;
}

struct Moving {
    Vector linear, angular, centre;
    double energy;

    explicit Moving(const World& world)
        : linear(linear_momentum(world)),
          angular(angular_momentum(world)),
          centre(centre_of_mass(world)),
          energy(kinetic_energy(world) + potential_energy(world)) {}
};

TEST(WhirledTrees, ThatFlyAreClosedAndKeepWhatTheyHave) {
    Random random(31);
    for (int draw = 0; draw < 200; ++draw) {
        World world = build_world(drawn_tree(random, false));
        stir(world, random, 0.02);
        const Moving before(world);
        WhirledTrees(world, make_plan(world)).close(world, kSubstep);
        const Moving after(world);
        EXPECT_LT(widest(world), 1e-12) << draw;
        EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * (1 + before.linear.norm()))
            << draw;
        EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * (1 + before.angular.norm()))
            << draw;
        EXPECT_LT((after.centre - before.centre).norm(), 1e-12) << draw;
        EXPECT_LT(after.energy, before.energy * (1 + 1e-10)) << draw;
    }
}

TEST(WhirledTrees, ThatAreFarOpenGainNoEnergyEither) {
    Random random(32);
    for (int draw = 0; draw < 200; ++draw) {
        World world = build_world(drawn_tree(random, false));
        stir(world, random, 0.3);
        const double open = widest(world);
        const Moving before(world);
        WhirledTrees(world, make_plan(world)).close(world, kSubstep);
        const Moving after(world);
        EXPECT_LE(widest(world), open) << draw;
        EXPECT_LT((after.angular - before.angular).norm(), 1e-11 * (1 + before.angular.norm()))
            << draw;
        EXPECT_LT(after.energy, before.energy + 1e-10 * std::abs(before.energy)) << draw;
    }
}

TEST(WhirledTrees, ThatHangAreClosedAndGainNoEnergy) {
    Random random(33);
    for (int draw = 0; draw < 200; ++draw) {
        World world = build_world(drawn_tree(random, true));
        stir(world, random, 0.02);
        const double before = Moving(world).energy;
        WhirledTrees(world, make_plan(world)).close(world, kSubstep);
        EXPECT_LT(widest(world), 1e-12) << draw;
        EXPECT_LT(Moving(world).energy, before + 1e-10 * std::abs(before)) << draw;
    }
}

TEST(WhirledTrees, ThatTouchNothingAreLeft) {
    Random random(35);
    World world = build_world(drawn_tree(random, false));
    stir(world, random, 0.02);
    world.contacts.found.clear();
    const std::vector<Vector> places = world.bodies.position;
    WhirledTrees(world, make_plan(world)).close(world, kSubstep);
    EXPECT_EQ(world.bodies.position, places);
}

TEST(WhirledTrees, ThatTurnLittleAreLeft) {
    Random random(34);
    World world = build_world(drawn_tree(random, false));
    stir(world, random, 0.02);
    const std::vector<Vector> places = world.bodies.position;
    WhirledTrees(world, make_plan(world)).close(world, 1e-4);
    EXPECT_EQ(world.bodies.position, places);
}

}  // namespace
}  // namespace plumb::test
