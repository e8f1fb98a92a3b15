// SPDX-License-Identifier: MIT
/// Bodies at rest: they do not sink, and the ground carries their weight.
#include "support/scenes.h"

namespace plumb::test {
namespace {

class Rest : public OnEveryCollider {};
INSTANTIATE_TEST_SUITE_P(, Rest, every_collider(), where_name);

TEST_P(Rest, NothingSinks) {
    for (bool fine : {false, true}) {
        Scene s = scene();
        if (fine) use_fine_steps(s.settings);
        add_ground(s);
        add_body(s, box(0.5, 0.5, 0.5), {0, 0.5, 0});
        add_body(s, sphere(0.3), {2, 0.3, 0});
        add_body(s, capsule(0.2, 0.5), {-2, 0.2, 0}).placement.rotation =
            Rotation(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitX()));
        Simulation simulation(s, colliders(), collider());
        run_for(simulation, 5);
        const auto& x = simulation.world().bodies.position;
        EXPECT_NEAR(x[1].y(), 0.5, 1e-4);
        EXPECT_NEAR(x[2].y(), 0.3, 1e-4);
        EXPECT_NEAR(x[3].y(), 0.2, 1e-4);
    }
}

/// A stack of ten, 1/60 s with 20 substeps × (10 + 10): it does not sink by a thousandth of an
/// edge.
TEST_P(Rest, AStackOfTenKeepsItsHeight) {
    Scene s = scene();
    use_fine_steps(s.settings);
    s.settings.velocity_iterations = s.settings.position_iterations = 10;
    add_ground(s);
    for (int i = 0; i < 10; ++i) add_body(s, box(0.5, 0.5, 0.5), {0, 0.5 + i, 0});
    Simulation simulation(s, colliders(), collider());
    run_for(simulation, 10);
    for (std::size_t i = 1; i <= 10; ++i)
        EXPECT_NEAR(simulation.world().bodies.position[i].y(), static_cast<double>(i) - 0.5, 1e-3);
}

}  // namespace
}  // namespace plumb::test
