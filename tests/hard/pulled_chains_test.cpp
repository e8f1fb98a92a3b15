// SPDX-License-Identifier: MIT
/// Chains between a post and what a script moves: pulled beyond their length, which no joint can
/// follow, pushed together, and brought back. They open and sag, but nothing flies, and they hang
/// together again.
#include "support/draw_settings.h"
#include "support/random.h"
#include "support/scenes.h"

namespace plumb::test {
namespace {

constexpr double kLink = 0.4;                        // [m]
constexpr double kPulled = 1, kLeft = 2, kBack = 3;  // [s]
constexpr double kHangs = 8;                         // [s]
constexpr double kFast = 30;                         // [m/s]
constexpr double kOpen = kLink / 10;                 // [m]

/// Beyond this a rod may come to lie the other way round between its neighbours, and stays so.
constexpr double kFarPull = 1.25;

struct Pull {
    std::uint32_t links;
    double to;  ///< share of the length at which the ends stand when it is pulled most
};

Keyframe at(double time, double x) {
    Keyframe k;
    k.time = time, k.placement.position = {x, 3, 0};
    return k;
}

/// Rods that hang together by balls, or by hinges about z, the first on a post.
Scene chain(const Pull& pull, JointKind kind) {
    Scene s;
    const auto apart = [](BodySpec& body) { body.mask = 0; };
    apart(add_body(s, sphere(0.05), {0, 3, 0}, Motion::fixed));
    for (std::uint32_t i = 0; i < pull.links; ++i) {
        BodySpec& rod = add_body(s, capsule(0.03, kLink / 2 - 0.05), {(i + 0.5) * kLink, 3, 0});
        rod.placement.rotation = Rotation(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitZ()));
        apart(rod);
    }
    const double length = pull.links * kLink;
    BodySpec& puller = add_body(s, sphere(0.05), {length, 3, 0}, Motion::kinematic);
    puller.script.keyframes = {at(0, length), at(kPulled, pull.to * length),
                               at(kLeft, pull.to * length), at(kBack, length)};
    apart(puller);
    for (std::uint32_t i = 0; i <= pull.links; ++i) {
        JointSpec& joint = add_joint(s, kind, i, i + 1, {i * kLink, 3, 0});
        joint.frame = Rotation(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector::UnitY()));
    }
    return s;
}

class PulledChains : public InEachPrecision {};
INSTANTIATE_TEST_SUITE_P(, PulledChains, each_precision(), precision_name);

TEST_P(PulledChains, OpenAndHangTogetherAgain) {
    Random random(7);
    for (int draw = 0; draw < 9; ++draw) {
        const Pull pull{1 + random.below(12),
                        random.below(3) == 0 ? random.number(0.5, 0.95) : random.number(1.02, 1.6)};
        Scene s = chain(pull, random.below(3) == 0 ? JointKind::hinge : JointKind::ball);
        s.settings.precision = GetParam();
        draw_settings(s.settings, random, draw);
        Simulation simulation(s, colliders(), "ode");
        double fastest = 0, open = 0;
        while (simulation.time() < kHangs) {
            ASSERT_TRUE(simulation.step().finite) << "draw " << draw;
            fastest = std::max(fastest, fastest_point(simulation.world()));
        }
        for (const double error : joint_errors(simulation.world())) open = std::max(open, error);
        EXPECT_LT(fastest, kFast) << "draw " << draw;
        if (pull.to > kFarPull) continue;
        EXPECT_LT(open, kOpen) << "draw " << draw << ", " << pull.links << " links pulled to "
                               << pull.to << ", " << s.settings.dt << " s x "
                               << s.settings.substeps;
    }
}

}  // namespace
}  // namespace plumb::test
