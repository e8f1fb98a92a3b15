// SPDX-License-Identifier: MIT
/// What is squeezed out from between two plates that close, without friction: it leaves at the
/// speed that their angle asks for, V / tan a, whatever the settings.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::test {
namespace {

class Wedges : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Wedges, every_collider(), where_name);

constexpr double kRadius = 0.1;  // of the ball [m]

/// A ball, and on either side a plate that leans outwards by an angle [rad], 1 cm away.
void add_wedge(Scene& s, double angle) {
    constexpr double kGap = 0.01, kHalf = 0.1;
    s.settings.gravity.setZero();
    s.materials[0].friction = 0;
    add_body(s, sphere(kRadius), Vector::Zero());
    for (const double side : {1.0, -1.0}) {
        const Vector out(side * std::cos(angle), -std::sin(angle), 0);
        add_body(s, box(kHalf, 5, 1), (kRadius + kGap + kHalf) * out, Motion::kinematic)
            .placement.rotation = Eigen::AngleAxisd(-side * angle, Vector::UnitZ());
    }
}

TEST_P(Wedges, LetABallOutAsFastAsTheirAngleAsksFor) {
    Random random(1);
    for (int draw = 0; draw < 30; ++draw) {
        const double angle =
            std::exp(random.number(std::log(2.0), std::log(20.0))) * std::numbers::pi / 180;
        const double closing = random.number(0.02, 0.3);
        Scene s = scene();
        add_wedge(s, angle);
        draw_settings(s.settings, random, draw);
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", " << angle << " rad, " << closing << " m/s, "
                     << s.settings.dt << " s in " << s.settings.substeps);
        Simulation simulation(s, colliders(), collider());
        simulation.set_velocity(1, {-closing, 0, 0}, Vector::Zero());
        simulation.set_velocity(2, {closing, 0, 0}, Vector::Zero());
        double fastest = 0;
        while (simulation.world().bodies.position[0].y() < 0.5 && simulation.time() < 5) {
            simulation.step();
            fastest = std::max(fastest, simulation.world().bodies.velocity[0].norm());
        }
        // what overlaps when the plates meet the ball is pushed out on top of that
        const double exact = closing / std::tan(angle);
        EXPECT_GT(fastest, 0.95 * exact);
        EXPECT_LT(fastest, (1 + 1.5 * s.settings.stiffness) * exact);
    }
}

}  // namespace
}  // namespace plumb::test
