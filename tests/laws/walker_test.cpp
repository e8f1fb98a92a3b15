// SPDX-License-Identifier: MIT
/// A machine whose linkages close six loops walks by its geometry: 0.4 m in half a turn of its
/// cranks.
#include "reader/reader.h"
#include "support/scenes.h"

#include <algorithm>

namespace plumb::test {
namespace {

class Walker : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(
    , Walker,
    testing::Combine(testing::Values(std::string("ode"), std::string("bullet")), each_precision()),
    where_name);

TEST_P(Walker, GoesAsFarAsItsStepsAreLongAndItsLoopsHold) {
    Scene s = read_scene(PLUMB_SAMPLES "/scenes/walker.json");
    s.settings.precision = std::get<1>(GetParam());
    const auto frame = static_cast<std::uint32_t>(
        std::find_if(s.bodies.begin(), s.bodies.end(),
                     [](const BodySpec& body) { return body.name == "frame"; }) -
        s.bodies.begin());
    Simulation simulation(s, colliders(), collider());
    const World& world = simulation.world();
    double parted = 0, turned = 0, rise = 0;
    for (int i = 0; i < 2000; ++i) {
        ASSERT_TRUE(simulation.step().finite);
        for (const double e : joint_errors(world)) parted = std::max(parted, e);
        for (const double e : joint_turn_errors(world)) turned = std::max(turned, e);
        rise = std::max(rise, std::abs(world.bodies.position[frame].y() - 0.3));
    }
    EXPECT_LT(parted, 1e-4);
    EXPECT_LT(turned, 1e-3);
    EXPECT_LT(rise, 2e-3) << "the frame glides";

    const double half_turns = simulation.joint_motion(0, kTurnX).position / std::numbers::pi;
    EXPECT_NEAR(half_turns, 9.5, 0.05);
    const Vector gone = world.bodies.position[frame] - Vector(0, 0.3, 0);
    EXPECT_NEAR(gone.x(), 0.4 * half_turns, 0.02 * gone.x());
    EXPECT_LT(std::abs(gone.z()), 0.01);
}

}  // namespace
}  // namespace plumb::test
