// SPDX-License-Identifier: MIT
/// Thin rods that hang a little beside their axis. The joint's pull turns such a rod about its
/// axis, where it has next to no inertia: at hundreds of radians a second.
#include "support/random.h"
#include "support/scenes.h"

#include <cmath>

namespace plumb::test {
namespace {

class ThinRods : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, ThinRods, each_precision(), precision_name);

/// A rod from 1 : 20 to 1 : 300 on a ball joint somewhere in its end, let go anywhere.
Scene hanging_rod(Precision precision, Random& random) {
    Scene s;
    s.settings.precision = precision;
    s.settings.forbid = {"contacts"};
    const double half = random.number(0.1, 0.5);
    const double thickness = half / (20 * std::pow(15, random.number(0, 1)));
    const Rotation turn = random.rotation();
    const Vector arm =
        turn * Vector(random.number(-1, 1) * thickness, half, random.number(-1, 1) * thickness);
    BodySpec& body = add_body(s, box(thickness, half, thickness), -arm);
    body.placement.rotation = turn;
    body.angular_velocity = random.number(0.5, 3) * random.direction();
    body.velocity = body.angular_velocity.cross(-arm);
    JointSpec joint;
    joint.body_a = 0;
    joint.anchor = Vector::Zero();
    s.joints.push_back(joint);
    return s;
}

/// Energy at one time of places and velocities, which are those of half a part earlier; above that
/// of the rod hanging down [J].
double swing_energy(const Simulation& simulation) {
    const World& w = simulation.world();
    const double parts = std::max(w.joints.joints[0].pace.parts, 1u) * w.settings.substeps;
    const double late = 0.5 * w.settings.dt / parts;
    const Bodies& b = w.bodies;
    return total_energy(simulation) +
           9.81 * b.mass[0] * (b.position[0].norm() - late * b.velocity[0].y());
}

TEST_P(ThinRods, HangTogetherAndKeepTheirEnergy) {
    Random random(31);
    for (int draw = 0; draw < 45; ++draw) {
        Scene s = hanging_rod(GetParam(), random);
        if (draw % 3 == 1) use_fine_steps(s.settings);
        if (draw % 3 == 2)
            s.settings.dt = random.number(0.002, 0.02), s.settings.substeps = 1 + random.below(20);
        SCOPED_TRACE(testing::Message()
                     << "draw " << draw << ", " << s.settings.dt << " s x " << s.settings.substeps);
        Simulation simulation(s, colliders(), "reference");
        const double before = swing_energy(simulation);
        double most = before, least = before, widest = 0;
        while (simulation.time() < 20) {
            const StepReport report = simulation.step();
            ASSERT_EQ(report.unsolved_trees, 0u) << "open by " << report.tree_error;
            widest = std::max(widest, joint_errors(simulation.world())[0]);
            most = std::max(most, swing_energy(simulation));
            least = std::min(least, swing_energy(simulation));
        }
        EXPECT_LT(widest, 2e-6);
        EXPECT_LT(most / before, 1.01);
        EXPECT_GT(least / before, 0.98);
    }
}

/// Where substeps may not be divided, such rods tear themselves loose. The step says how far.
TEST_P(ThinRods, ThatAreNotSolvedAreReportedAsOpenAsTheyAre) {
    constexpr double kOpen = 1e-5;  // [m]
    Random random(32);
    int open = 0;
    for (int draw = 0; draw < 10; ++draw) {
        Scene s = hanging_rod(GetParam(), random);
        s.settings.tree_parts = 1;
        Simulation simulation(s, colliders(), "reference");
        while (simulation.time() < 5) {
            const StepReport report = simulation.step();
            const double error = joint_errors(simulation.world())[0];
            open += report.unsolved_trees > 0;
            ASSERT_GE(std::max(report.tree_error, kOpen), error)
                << "draw " << draw << ", " << simulation.time() << " s";
        }
    }
    EXPECT_GT(open, 0);
}

}  // namespace
}  // namespace plumb::test
