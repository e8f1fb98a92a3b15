// SPDX-License-Identifier: MIT
/// Free figures of few bodies, whose joints are of all kinds and have limits, friction and springs,
/// fall on the ground: in the air they are iterated or solved as trees, where they touch as
/// islands.
#include "support/random.h"
#include "support/scenes.h"
#include "ties/joint_state.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

class ThrownFigures : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, ThrownFigures, every_collider(), where_name);

JointSpec drawn_joint(Random& random) {
    constexpr JointKind kKinds[] = {JointKind::ball, JointKind::hinge, JointKind::universal,
                                    JointKind::slider};
    JointSpec joint;
    joint.kind = kKinds[random.below(4)];
    joint.frame = random.rotation();
    if (joint.kind == JointKind::ball) return joint;
    const bool slides = joint.kind == JointKind::slider;
    JointAxisSpec& axis = joint.axes[slides ? kAlongX : kTurnX];
    const std::uint32_t law = random.below(4);
    if (law == 0) axis.friction = random.number(0.1, 2);
    if (law == 1) axis.stiffness = random.number(5, 50), axis.damping = random.number(0, 1);
    if (law == 2 || slides) axis.lower = slides ? -0.02 : -0.3, axis.upper = -axis.lower;
    return joint;
}

/// Two to five boxes in a row, each on the one before.
Scene figure(Scene s, Random& random) {
    add_ground(s);
    const std::uint32_t count = 2 + random.below(4);
    const Rotation turn = random.rotation();
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector half(random.number(0.05, 0.12), random.number(0.1, 0.2), 0.1);
        BodySpec& body = add_body(s, box(half.x(), half.y(), half.z()), {0.5 * i, 0.6, 0});
        body.placement.rotation = turn;
        if (i == 0) continue;
        JointSpec joint = drawn_joint(random);
        joint.body_a = i + 1, joint.body_b = i;
        joint.anchor = Vector(0.5 * i - 0.25, 0.6, 0);
        s.joints.push_back(joint);
    }
    return s;
}

TEST_P(ThrownFigures, GainNothingAndStayTogether) {
    Random random(41);
    for (int draw = 0; draw < 28; ++draw) {
        Scene s = figure(scene(), random);
        if (draw % 4 == 1) use_fine_steps(s.settings);
        if (draw % 4 == 2) s.settings.dt = 0.002;
        if (draw % 4 == 3)
            s.settings.dt = random.number(0.002, 0.02), s.settings.substeps = 1 + random.below(20);
        SCOPED_TRACE(testing::Message() << "draw " << draw << ", " << s.joints.size() << " joints, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        const double start = total_energy(simulation);
        double most = start, widest = 0;
        while (simulation.time() < 3) {
            simulation.step();
            most = std::max(most, total_energy(simulation));
            const World& world = simulation.world();
            for (const Joint& joint : world.joints.joints)
                widest = std::max(widest, joint_gap(world.bodies, joint));
        }
        EXPECT_LT(most, 1.001 * start);
        EXPECT_LT(widest, 0.01);
        EXPECT_LT(fastest_point(simulation.world()), 0.5);
    }
}

}  // namespace
}  // namespace plumb::test
