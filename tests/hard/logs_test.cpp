// SPDX-License-Identifier: MIT
/// Round timber: logs in layers between two posts lie still. Side by side they touch along a line,
/// whose normal a collider has to find exactly: one that wanders by milliradians keeps them moving.
#include "support/scenes.h"

#include <cmath>
#include <numbers>

namespace plumb::test {
namespace {

constexpr double kRadius = 0.15, kHalfLength = 0.5;  // [m]

class Logs : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Logs, every_collider(), where_name);

/// Four, and three in their hollows.
Scene logs_between_posts(Scene s) {
    s.materials[0].friction = 0.6, s.materials[0].rolling_friction = 1e-3;
    add_ground(s);
    for (const double side : {-1, 1})
        add_body(s, box(0.05, 0.3, 0.6), {side * (4 * kRadius + 0.05), 0.3, 0}, Motion::fixed);
    for (int layer = 0; layer < 2; ++layer)
        for (int i = 0; i < 4 - layer; ++i)
            add_body(s, cylinder(kRadius, kHalfLength),
                     {(2 * i + layer - 3) * kRadius, (1 + std::sqrt(3) * layer) * kRadius, 0})
                .placement.rotation = Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitX());
    return s;
}

TEST_P(Logs, LieStill) {
    if (collider() == "reference") GTEST_SKIP() << "no cylinders on planes";
    for (const double reuse : {Settings{}.reuse_distance, 0.0})
        for (const auto& [dt, substeps] :
             {std::pair{0.01, 1u}, {0.01, 40u}, {0.005, 1u}, {0.017, 3u}}) {
            SCOPED_TRACE(std::to_string(dt) + " s x " + std::to_string(substeps) + ", reuse " +
                         std::to_string(reuse));
            Scene s = logs_between_posts(scene());
            s.settings.dt = dt, s.settings.substeps = substeps;
            s.settings.reuse_distance = reuse;
            Simulation simulation(s, colliders(), collider());
            const std::vector<Vector> start = simulation.world().bodies.position;
            EXPECT_LT(motions_between(simulation, 3, 3 + 200 * dt).fastest, 1e-4);
            EXPECT_LT(farthest_from(start, simulation.world()), 1e-4) << "since they were laid";
        }
}

}  // namespace
}  // namespace plumb::test
