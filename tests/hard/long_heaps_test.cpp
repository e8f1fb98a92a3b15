// SPDX-License-Identifier: MIT
/// Heaps of 300 bodies at default settings, over minutes: from 60 s on no body moves by more than 1
/// mm, and the heap keeps its height. Variables of the environment change what is run:
///   PLUMB_HEAP_SECONDS    how long [s] (75; tests/long.sh: 600)
///   PLUMB_TEST_COLLIDERS  on which, separated by commas (ode; cubes on fcl, where they once crept)
///   PLUMB_HEAP_PRECISION  single or double (single)
///   PLUMB_HEAPS           of what, separated by commas (cubes, capsules, tori)
#include "host/simulation.h"
#include "reader/reader.h"
#include "support/scenes.h"
#include "support/structures.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <sstream>

namespace plumb::test {
namespace {

std::string setting(const char* name, const char* otherwise) {
    const char* value = std::getenv(name);
    return value ? value : otherwise;
}

std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> parts;
    std::istringstream stream(list);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

double mean_height(const World& world) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        if (world.bodies.motion[i] == Motion::dynamic) sum += world.bodies.position[i].y(), ++count;
    return sum / count;
}

/// A heap that sweeps carry well enough takes at most one step in some 2000 to find that its laws
/// cannot be solved exactly, however many substeps and however little work each.
TEST(LargeHeaps, AreNotSolvedInVainAgainAndAgain) {
    Scene scene = read_scene(PLUMB_TEST_ROOT "/samples/scenes/pile.json");
    scene.settings.substeps = 4;
    scene.settings.velocity_iterations = scene.settings.position_iterations = 1;
    const ColliderLibrary colliders(PLUMB_TEST_PLUGINS);
    Simulation simulation(scene, colliders, "ode");
    int tried = 0;
    for (int step = 0; step < 1000; ++step) {
        ASSERT_TRUE(simulation.step().finite);
        for (const IslandResidual& island : simulation.island_residuals())
            tried += island.exact && island.bodies > scene.settings.exact_islands;
    }
    EXPECT_LE(tried, 2);
}

/// 2500 bricks that all move down at first: what is in vain in some steps holds them in the end.
TEST(LargeWalls, StandAJolt) {
    Scene scene;
    scene.materials[0].friction = 0.5;
    add_ground(scene);
    add_structure(scene, wall(100, 25, {0.1, 0.035, 0.05}, 0));
    for (BodySpec& body : scene.bodies)
        if (body.motion == Motion::dynamic) body.velocity = {0, -0.02, 0};
    const ColliderLibrary colliders(PLUMB_TEST_PLUGINS);
    Simulation simulation(scene, colliders, "ode");
    const std::vector<Eigen::Vector3d> start = simulation.world().bodies.position;
    while (simulation.time() < 1) ASSERT_TRUE(simulation.step().finite);
    EXPECT_LT(farthest_from(start, simulation.world()), 1e-6);
}

void expect_stays(const std::string& heap, const std::string& collider, double seconds) {
    Scene scene =
        read_scene(std::string(PLUMB_TEST_ROOT "/tests/hard/scenes/heap_") + heap + ".json");
    const std::string precision = setting("PLUMB_HEAP_PRECISION", "single");
    scene.settings.precision = precision == "double" ? Precision::double_ : Precision::single;
    const ColliderLibrary colliders(PLUMB_TEST_PLUGINS);
    Simulation simulation(scene, colliders, collider);
    while (simulation.time() < 60) simulation.step();
    const std::vector<Eigen::Vector3d> start = simulation.world().bodies.position;
    const double height = mean_height(simulation.world());
    double moved = 0;
    int steps = 0, missed = 0;  // by an island
    for (; simulation.time() < seconds; ++steps) {
        const StepReport report = simulation.step();
        ASSERT_TRUE(report.finite);
        missed += report.unsolved_islands > 0;
        moved = std::max(moved, farthest_from(start, simulation.world()));
    }
    const double risen = mean_height(simulation.world()) - height;
    std::cout << heap << " on " << collider << " in " << precision << ", 60 to " << seconds
              << " s: no body moved by more than " << moved * 1e3 << " mm, mean height by "
              << risen * 1e3 << " mm; steps that an island missed: " << missed << " of " << steps
              << "\n";
    EXPECT_LT(moved, 1e-3);
    EXPECT_LT(std::abs(risen), 0.05e-3);
    EXPECT_LE(missed, steps / 100);
}

class LongHeaps : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, LongHeaps,
                         testing::ValuesIn(split(setting("PLUMB_HEAPS", "cubes,capsules,tori"))),
                         [](const auto& test) { return test.param; });

TEST_P(LongHeaps, StayAsTheyLie) {
    std::istringstream colliders(
        setting("PLUMB_TEST_COLLIDERS", GetParam() == "cubes" ? "fcl" : "ode"));
    for (std::string collider; std::getline(colliders, collider, ',');)
        expect_stays(GetParam(), collider, std::stod(setting("PLUMB_HEAP_SECONDS", "75")));
}

/// The sample's wrecking ball throws bricks about, and from 15 s on all of them lie still.
TEST(WreckedWall, BricksComeToRest) {
    for (const char* collider : {"reference", "ode", "bullet", "fcl"}) {
        const Scene scene = read_scene(PLUMB_TEST_ROOT "/samples/scenes/wall.json");
        const ColliderLibrary colliders(PLUMB_TEST_PLUGINS);
        Simulation simulation(scene, colliders, collider);
        const Bodies& b = simulation.world().bodies;
        const std::vector<Eigen::Vector3d> start = b.position;
        double fastest = 0;
        while (simulation.time() < 20) {
            simulation.step();
            if (simulation.time() < 15) continue;
            for (std::size_t i = 0; i < b.size(); ++i)
                if (scene.bodies[i].name != "ball")
                    fastest =
                        std::max(fastest, b.velocity[i].norm() +
                                              b.bounding_radius[i] * b.angular_velocity[i].norm());
        }
        int thrown = 0;
        for (std::size_t i = 0; i < b.size(); ++i)
            thrown += (b.position[i] - start[i]).norm() > 0.3;
        std::cout << "wall on " << collider << ": " << thrown << " bodies thrown, then at most "
                  << fastest * 1e3 << " mm/s\n";
        EXPECT_GT(thrown, 5) << collider;
        EXPECT_LT(fastest, 1e-4) << collider;
    }
}

}  // namespace
}  // namespace plumb::test
