// SPDX-License-Identifier: MIT
/// Chains that whirl into the ground hold together, at settings of all kinds.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"
#include "ties/joint_state.h"

#include <cmath>

namespace plumb::test {
namespace {

class WhirledChains : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, WhirledChains, every_collider(), where_name);

constexpr JointKind kKinds[] = {JointKind::ball, JointKind::hinge, JointKind::universal};

Settings drawn_settings(Settings s, Random& random, int draw) {
    if (draw % 3 == 1) use_fine_steps(s);
    if (draw % 3 == 2) draw_steps(s, random, {0.001, 0.02, 40, 1, 50});
    return s;
}

/// Links around the origin that turn as one about their centre [rad/s].
void add_chain(Scene& s, Random& random, std::uint32_t links, const Vector& rate) {
    Vector end = Vector::Zero(), way = random.direction();
    const JointKind kind = kKinds[random.below(3)];
    for (std::uint32_t i = 0; i < links; ++i) {
        const double length = random.number(0.1, 0.4), radius = random.number(0.05, 0.12) * length;
        way = (way + random.vector(0.3)).normalized();
        const Vector half = length / 2 * way;
        BodySpec& link = random.below(2) == 0
                             ? add_body(s, capsule(radius, length / 2 - radius), end + half)
                             : add_body(s, box({radius, length / 2, 0.7 * radius}), end + half);
        link.placement.rotation = rotation_between(Vector::UnitY(), way);
        if (i > 0) add_joint(s, kind, i, i - 1, end).frame = random.rotation();
        end += 2 * half;
    }
    for (BodySpec& link : s.bodies) {
        link.placement.position -= end / 2;
        link.velocity = rate.cross(link.placement.position), link.angular_velocity = rate;
    }
    for (JointSpec& joint : s.joints) joint.anchor -= end / 2;
}

double rim_of(const Scene& s) {
    double reach = 0;
    for (const BodySpec& link : s.bodies)
        reach = std::max(reach, link.placement.position.norm() + 0.25);
    return reach;
}

/// How far joints are open [m].
double widest_opening(const World& world) {
    double most = 0;
    for (const Joint& joint : world.joints.joints)
        most = std::max(most, joint_gap(world.bodies, joint));
    return most;
}

TEST_P(WhirledChains, HoldTogetherWhereTheyStrikeTheGround) {
    Random random(21);
    for (int draw = 0; draw < 18; ++draw) {
        Scene s = scene();
        s.settings = drawn_settings(s.settings, random, draw);
        s.materials[0].friction = random.number(0, 1);
        add_chain(s, random, 2 + random.below(5), random.number(5, 20) * random.direction());
        const Vector thrown(random.number(-1, 1), random.number(-3, 0), random.number(-1, 1));
        for (BodySpec& link : s.bodies) link.velocity += thrown;
        add_body(s, box(8, 0.5, 8), {0, -rim_of(s) - 0.5, 0}, Motion::fixed);
        Simulation simulation(s, colliders(), collider());
        double most = 0;
        while (simulation.time() < 1.5) {
            ASSERT_TRUE(simulation.step().finite);
            most = std::max(most, widest_opening(simulation.world()));
        }
        EXPECT_LT(most, 5e-3) << "draw " << draw;
    }
}

}  // namespace
}  // namespace plumb::test
