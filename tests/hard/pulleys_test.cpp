// SPDX-License-Identifier: MIT
/// Chains that bear heavy loads, over wheels and in ropes: what hangs stays where it is, and joints
/// stay closed, however much heavier the load is than a link.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

/// A wheel, and links whose middles touch it: side by side their joints form a regular polygon of
/// which each link is a side, so that all bear the same.
struct Pulley {
    int links;
    double wheel, link;  ///< radii [m]
    double load;         ///< masses of a link are 1 [kg]

    double angle() const { return std::numbers::pi / links; }
    double half() const { return (wheel + link) * std::tan(angle() / 2); }
};

Scene over(const Pulley& pulley, Scene s) {
    s.materials[0].friction = 0.4;
    const Rotation lying(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitX()));
    BodySpec& wheel = add_body(s, cylinder(pulley.wheel, 0.2), {0, 0, 0}, Motion::fixed);
    wheel.placement.rotation = lying;
    const auto direction = [](double angle) { return Vector(std::sin(angle), std::cos(angle), 0); };
    const double reach = std::hypot(pulley.wheel + pulley.link, pulley.half());
    const double first = -std::numbers::pi / 2;
    for (int i = 0; i < pulley.links; ++i) {
        const double angle = first + (i + 0.5) * pulley.angle();
        const double cap = 0.9 * pulley.half() - pulley.link;
        BodySpec& link = add_body(s, cap > 0 ? capsule(pulley.link, cap) : sphere(pulley.link),
                                  (pulley.wheel + pulley.link) * direction(angle));
        link.placement.rotation =
            rotation_between(Vector::UnitY(), direction(angle + std::numbers::pi / 2));
        link.mass = 1;
        link.group = 2, link.mask = 1;  // links touch the wheel, not each other
    }
    for (const int side : {-1, 1}) {
        BodySpec& load = add_body(s, box(0.05, 0.05, 0.05), {side * reach, -0.3, 0});
        load.mass = pulley.load, load.mask = 0;
    }
    const auto links = static_cast<std::uint32_t>(pulley.links);
    for (std::uint32_t i = 1; i < links; ++i)
        add_joint(s, JointKind::ball, i + 1, i, reach * direction(first + i * pulley.angle()));
    add_joint(s, JointKind::ball, links + 1, 1, reach * direction(first));
    add_joint(s, JointKind::ball, links + 2, links, reach * direction(-first));
    return s;
}

class Pulleys : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Pulleys,
                         testing::Combine(testing::Values(std::string("ode"), std::string("bullet"),
                                                          std::string("fcl")),
                                          each_precision()),
                         where_name);

TEST_P(Pulleys, ChainsHangOverThemAtAnyLoad) {
    Random random(4);
    for (int draw = 0; draw < 10; ++draw) {
        Scene empty = scene();
        if (draw > 1)
            draw_steps(empty.settings, random, {0.004, 1.0 / 60, 4, 1, 12});
        else if (draw > 0)
            empty.settings.dt = 1.0 / 60;
        const Pulley pulley{4 + 2 * static_cast<int>(random.below(9)), random.number(0.05, 0.5),
                            random.number(0.01, 0.03), std::pow(10, random.number(0, 4))};
        SCOPED_TRACE(testing::Message() << pulley.links << " links, " << pulley.load
                                        << " of each, on a wheel of " << pulley.wheel << " m, "
                                        << empty.settings.dt << " s x " << empty.settings.substeps);
        Simulation simulation(over(pulley, empty), colliders(), collider());
        const std::vector<Vector> start = simulation.world().bodies.position;
        double widest = 0;
        while (simulation.time() < 3) {
            ASSERT_TRUE(simulation.step().finite);
            widest = std::max(widest, widest_joint(simulation.world()));
        }
        EXPECT_LT(widest, 1e-5);
        EXPECT_LT(farthest_from(start, simulation.world()), 1e-3);
        EXPECT_LT(fastest_point(simulation.world()), 1e-3);
    }
}

class LoadedRopes : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, LoadedRopes, each_precision(), precision_name);

/// Points on distance joints that only limit, and a load on the last one.
TEST_P(LoadedRopes, OfDistanceLimitsDoNotStretch) {
    Random random(5);
    for (int draw = 0; draw < 12; ++draw) {
        Scene s;
        s.settings.precision = GetParam();
        if (draw > 1) draw_steps(s.settings, random, {0.002, 1.0 / 30, 6, 1, 12});
        const std::uint32_t points = draw == 0 ? 1 : 1 + random.below(20);
        const double load = draw == 0 ? 100 : std::pow(10, random.number(0, 3));
        const double length = 1.0 / points;
        SCOPED_TRACE(testing::Message() << points << " points, " << load << " of each, "
                                        << s.settings.dt << " s x " << s.settings.substeps);
        for (std::uint32_t i = 0; i < points; ++i) {
            BodySpec& point = add_body(s, sphere(0.02), {0, -length * (i + 1), 0});
            point.mass = 0.01, point.mask = 0;
            JointSpec& joint = add_joint(s, JointKind::distance, i, i > 0 ? i - 1 : kNoIndex,
                                         point.placement.position);
            joint.anchor_b = Vector(0, -length * i, 0);
            joint.axes[kAlongX].lower = 0, joint.axes[kAlongX].upper = length;
        }
        BodySpec& weight = add_body(s, box(0.1, 0.1, 0.1), {0, -1.1, 0});
        weight.mass = 0.01 * load, weight.mask = 0;
        add_joint(s, JointKind::ball, points, points - 1, {0, -1, 0});
        Simulation simulation(s, colliders(), "ode");
        run_for(simulation, 5);
        EXPECT_NEAR(simulation.world().bodies.position[points].y(), -1.1, 1e-5);
        EXPECT_LT(fastest_point(simulation.world()), 1e-4);
    }
}

}  // namespace
}  // namespace plumb::test
