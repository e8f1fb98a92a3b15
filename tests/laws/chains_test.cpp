// SPDX-License-Identifier: MIT
/// Chains that hang: their shape, their stretch and the force at the top. 1/60 s × substeps of one
/// iteration, unless a test says otherwise.
#include "support/scenes.h"
#include "ties/joint_state.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace plumb::test {
namespace {

class Chains : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, Chains, each_precision(), precision_name);

/// Slopes of the links of a catenary: tan θ_i = (i − (N − 1)/2) w/H, w a link's weight and H the
/// horizontal force, by bisection on the span.
std::vector<double> catenary_slopes(int links, double length, double span) {
    const auto slopes = [&](double share) {
        std::vector<double> angles;
        for (int i = 0; i < links; ++i)
            angles.push_back(std::atan((i - 0.5 * (links - 1)) * share));
        return angles;
    };
    const auto spanned = [&](double share) {
        double sum = 0;
        for (const double angle : slopes(share)) sum += length * std::cos(angle);
        return sum;
    };
    double low = 0, high = 10;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (spanned(middle) > span ? low : high) = middle;
    }
    return slopes(low);
}

/// A chain of rods on hinges from the origin on, one a slope, whose two ends are held.
Scene hung_chain(const std::vector<double>& slopes, double length) {
    Scene s;
    use_fine_steps(s.settings);
    s.settings.forbid = {"contacts"};
    Vector end = Vector::Zero();
    for (std::uint32_t i = 0; i <= slopes.size(); ++i) {
        JointSpec joint;
        joint.kind = JointKind::hinge;
        joint.frame = rotation_between(Vector::UnitX(), Vector::UnitZ());
        joint.body_a = i < slopes.size() ? i : i - 1;
        joint.body_b = i > 0 && i < slopes.size() ? i - 1 : kNoIndex;
        joint.anchor = end;
        s.joints.push_back(joint);
        if (i == slopes.size()) break;
        const Vector along(std::cos(slopes[i]), std::sin(slopes[i]), 0);
        add_body(s, box(0.5 * length, 0.05 * length, 0.05 * length), end + 0.5 * length * along)
            .placement.rotation = rotation_between(Vector::UnitX(), along);
        end += length * along;
    }
    return s;
}

/// Lets a scene come to rest by stopping it whenever its kinetic energy falls.
void relax(Simulation& simulation, int steps) {
    double before = 0;
    for (int i = 0; i < steps; ++i) {
        ASSERT_TRUE(simulation.step().finite);
        const double energy = kinetic_energy(simulation.world());
        if (energy < before)
            for (std::uint32_t k = 0; k < simulation.world().bodies.size(); ++k)
                simulation.set_velocity(k, Vector::Zero(), Vector::Zero());
        before = energy < before ? 0 : energy;
    }
}

/// Greatest distance of a chain's links from where the slopes have them [m].
double distance_from(const World& world, const std::vector<double>& slopes, double length) {
    Vector end = Vector::Zero();
    double greatest = 0;
    for (std::uint32_t i = 0; i < slopes.size(); ++i) {
        const Vector along = length * Vector(std::cos(slopes[i]), std::sin(slopes[i]), 0);
        greatest = std::max(greatest, (world.bodies.position[i] - end - 0.5 * along).norm());
        end += along;
    }
    return greatest;
}

/// A chain of 2 m between hooks 1 m apart, let go as a V. The deepest joint hangs 0.796462 m below
/// the hooks.
TEST_P(Chains, AHundredLinksFindTheCatenary) {
    constexpr std::uint32_t kLinks = 100;
    constexpr double kLength = 0.02, kSpan = 1;
    const std::vector<double> exact = catenary_slopes(kLinks, kLength, kSpan);
    std::vector<double> vee(kLinks, std::numbers::pi / 3);
    std::fill_n(vee.begin(), kLinks / 2, -std::numbers::pi / 3);
    for (const auto& [method, iterations, share] :
         {std::tuple{JointMethod::tree, 1u, 1e-4}, {JointMethod::iterate, 10u, 1e-2}}) {
        Scene s = hung_chain(vee, kLength);
        s.settings.precision = GetParam();
        s.settings.joints = method, s.settings.position_iterations = iterations;
        Simulation simulation(s, colliders(), "reference");
        relax(simulation, 200);
        const double off = distance_from(simulation.world(), exact, kLength);
        std::cout << "off by " << off << " m\n";
        EXPECT_LT(off, share * kLinks * kLength);
        const JointPose deepest =
            joint_pose(simulation.world().bodies, simulation.world().joints.joints[kLinks / 2]);
        EXPECT_NEAR(-deepest.point_a.y(), 0.796462, share * 0.796462);
    }
}

/// Weights of 1 kg, 0.1 m below each other on rods, the last `ratio` times as heavy.
Scene weights(std::uint32_t count, double ratio) {
    constexpr double kLength = 0.1;
    Scene s;
    use_fine_steps(s.settings);
    s.settings.forbid = {"contacts"};
    for (std::uint32_t i = 0; i < count; ++i) {
        add_body(s, sphere(0.02), {0, -kLength * (i + 1), 0}).mass = i + 1 < count ? 1 : ratio;
        JointSpec joint;
        joint.kind = JointKind::distance;
        joint.body_a = i, joint.body_b = i > 0 ? i - 1 : kNoIndex;
        joint.anchor = {0, -kLength * (i + 1), 0}, joint.anchor_b = Vector(0, -kLength * i, 0);
        s.joints.push_back(joint);
    }
    return s;
}

/// Mean force at the top against the weight, and the greatest stretch, in the second after the
/// first two.
struct Hanging {
    double force, stretch;
};
Hanging hang(const Scene& s) {
    Simulation simulation(s, colliders(), "reference");
    run_for(simulation, 2);
    const World& world = simulation.world();
    double weight = 0;
    for (const double mass : world.bodies.mass) weight += 9.81 * mass;
    Hanging mean{0, 0};
    for (int i = 0; i < 60; ++i) {
        simulation.step();
        mean.force += simulation.joint_load(0).force.y() / weight / 60;
        const double length = -world.bodies.position.back().y();
        mean.stretch = std::max(mean.stretch, length / (0.1 * world.bodies.size()) - 1);
    }
    return mean;
}

TEST_P(Chains, AsTreesBearAnyEnd) {
    for (const double ratio : {1e3, 1e4, 1e5, 1e6}) {
        Scene s = weights(20, ratio);
        s.settings.precision = GetParam();
        const Hanging mean = hang(s);
        EXPECT_NEAR(mean.force, 1, 1e-6) << ratio;
        EXPECT_LT(mean.stretch, 1e-6) << ratio;
    }
}

/// The end bounces on what the iterations leave open, so the force is right in the mean.
TEST_P(Chains, IteratedBearAThousandfoldEndInAHundredSubsteps) {
    Scene s = weights(20, 1e3);
    s.settings.precision = GetParam();
    s.settings.joints = JointMethod::iterate;
    s.settings.substeps = 100;
    const Hanging mean = hang(s);
    EXPECT_NEAR(mean.force, 1, 0.03);
    EXPECT_LT(mean.stretch, 0.03);
}

TEST_P(Chains, IteratedStretchFallsWithSubstepsAtOrderTwo) {
    double stretch[3];
    const std::uint32_t substeps[3] = {20, 40, 80};
    for (int i = 0; i < 3; ++i) {
        Scene s = weights(100, 1);
        s.settings.precision = GetParam();
        s.settings.joints = JointMethod::iterate;
        s.settings.substeps = substeps[i];
        stretch[i] = hang(s).stretch;
    }
    std::cout << "stretch " << stretch[0] << ", " << stretch[1] << ", " << stretch[2]
              << " at 20, 40, 80 substeps\n";
    EXPECT_LT(stretch[0], 0.01);
    EXPECT_GT(std::log2(stretch[0] / stretch[2]) / 2, 1.7);
}

}  // namespace
}  // namespace plumb::test
