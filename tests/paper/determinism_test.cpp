// SPDX-License-Identifier: MIT
/// The same bits, run after run, on any number of threads and any width of lanes.
#include "kernels/contact_kernels.h"
#include "support/scenes.h"

#include <random>

namespace plumb::test {
namespace {

/// A pile of 300 on a moving plate, with hung bodies and bouncing ones, so that every kernel has
/// work.
Scene busy_scene(Precision precision, bool shock) {
    Scene s;
    s.settings.precision = precision;
    s.settings.substeps = 2;
    if (shock) s.settings.require = {"shock_propagation"};
    s.materials[0].restitution = 0.3;
    s.materials[0].rolling_friction = 0.002;
    add_ground(s);
    BodySpec& plate = add_body(s, box(3, 0.1, 3), {0, 0.5, 0}, Motion::kinematic);
    plate.angular_velocity = {0, 0.5, 0};
    std::mt19937_64 random(42);
    auto jitter = [&] { return static_cast<double>(random() % 1000) * 2e-5; };
    for (int i = 0; i < 300; ++i) {
        const Vector x(0.5 * (i % 7) - 1.5 + jitter(), 1 + 0.5 * (i / 49),
                       0.5 * (i / 7 % 7) - 1.5 + jitter());
        add_body(s, i % 2 ? box(0.2, 0.15, 0.2) : sphere(0.2), x);
    }
    for (std::uint32_t i = 0; i < 20; ++i) {
        JointSpec joint;
        joint.body_a = 2 + i, joint.body_b = 3 + i;
        joint.anchor =
            0.5 * (s.bodies[2 + i].placement.position + s.bodies[3 + i].placement.position);
        s.joints.push_back(joint);
    }
    return s;
}

std::uint64_t hash_of(Scene scene, std::uint32_t threads, std::uint32_t lanes) {
    scene.settings.threads = threads;
    scene.settings.lanes = lanes;
    Simulation simulation(scene, colliders(), "reference");
    run_for(simulation, 0.8);
    return state_hash(simulation.world());
}

class Determinism : public testing::TestWithParam<std::tuple<Precision, bool>> {};
INSTANTIATE_TEST_SUITE_P(, Determinism, testing::Combine(each_precision(), testing::Bool()));

TEST_P(Determinism, SameBitsForAnyThreadsAndLanes) {
    const Scene scene = busy_scene(std::get<0>(GetParam()), std::get<1>(GetParam()));
    const std::uint64_t hash = hash_of(scene, 1, 1);
    EXPECT_EQ(hash_of(scene, 1, 1), hash) << "run twice";
    for (std::uint32_t lanes : {4u, 8u, 16u})
        if (static_cast<int>(lanes) <= widest_lanes()) {
            EXPECT_EQ(hash_of(scene, 1, lanes), hash) << lanes << " lanes";
        }
    for (std::uint32_t threads : {2u, 3u, 4u})
        EXPECT_EQ(hash_of(scene, threads, 4), hash) << threads << " threads";
}

}  // namespace
}  // namespace plumb::test
