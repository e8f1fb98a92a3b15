// SPDX-License-Identifier: MIT
/// Heaps that fall and come to rest without sleeping (§8): the pile of 2000, tori, hulls, bodies on
/// a mesh and on a height field; 0.01 s, 5 + 5 iterations, 10 s, on the colliders that
/// PLUMB_TEST_COLLIDERS names. Each must meet the figures of the pile, and lie as high as on the
/// others where the bodies are so many that chance does not tell. Sampled each 0.1 s of the last
/// 2 s, over the bodies within 8 m of the axis (without rolling friction some balls roll away).
/// How a heap falls hangs on its last digit: where single falls differ by much, the median of
/// several counts, each begun up to 0.05 mm aside.
#include "reader/reader.h"
#include "support/random.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace plumb::test {
namespace {

struct Rest {
    double median_speed = 0, p90_speed = 0;             ///< greatest of the samples [m/s]
    double mean_depth = 0, p99_depth = 0, deepest = 0;  ///< greatest of the samples [m]
    std::size_t bodies = 0, contacts = 0, away = 0, fallen = 0;
    double mean_height = 0;  ///< of those near the axis [m]
};

bool is_near(const World& world, std::size_t i) {
    const Vector& x = world.bodies.position[i];
    return std::hypot(x.x(), x.z()) <= 8;
}

void sample(const World& world, Rest& rest) {
    std::vector<double> speeds;
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
        if (world.bodies.motion[i] == Motion::dynamic && is_near(world, i))
            speeds.push_back(world.bodies.velocity[i].norm());
    rest.median_speed = std::max(rest.median_speed, percentile(speeds, 0.5));
    rest.p90_speed = std::max(rest.p90_speed, percentile(speeds, 0.9));
    const std::vector<double> depths = penetrations(world);
    double sum = 0;
    for (double d : depths) sum += d;
    rest.mean_depth =
        std::max(rest.mean_depth, depths.empty() ? 0 : sum / static_cast<double>(depths.size()));
    rest.p99_depth = std::max(rest.p99_depth, percentile(depths, 0.99));
    rest.deepest = std::max(rest.deepest, percentile(depths, 1));
}

void measure_end(const World& world, Rest& rest) {
    rest.contacts = world.contacts.found.size();
    std::size_t near = 0;
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
        if (world.bodies.motion[i] != Motion::dynamic) continue;
        ++rest.bodies;
        rest.fallen += world.bodies.position[i].y() < -1.2;
        if (!is_near(world, i)) {
            ++rest.away;
            continue;
        }
        rest.mean_height += world.bodies.position[i].y();
        ++near;
    }
    rest.mean_height /= static_cast<double>(near);
}

/// Moves what can fall by up to 0.05 mm along each axis.
void shake(Scene& scene, unsigned seed) {
    Random random(seed);
    for (BodySpec& body : scene.bodies)
        if (body.motion == Motion::dynamic)
            for (double& x : body.placement.position) x += random.number(-0.05e-3, 0.05e-3);
}

/// One fall of the scene; of `start` 0 as it stands in the file.
Rest fall(const std::filesystem::path& file, const std::string& collider, unsigned start) {
    Rest rest;
    Scene scene = read_scene(file);
    if (start > 0) shake(scene, start);
    Simulation simulation(scene, colliders(), collider);
    for (int i = 1; i <= 1000; ++i) {
        EXPECT_TRUE(simulation.step().finite);
        if (i >= 800 && i % 10 == 0) sample(simulation.world(), rest);
    }
    measure_end(simulation.world(), rest);
    std::cout << file.stem().string() << " on " << collider << ": speed median "
              << rest.median_speed * 1e3 << ", 90 % " << rest.p90_speed * 1e3
              << " mm/s; penetration mean " << rest.mean_depth * 1e3 << ", 99 % "
              << rest.p99_depth * 1e3 << ", largest " << rest.deepest * 1e3 << " mm; "
              << rest.contacts << " contacts, " << rest.away << " rolled away, mean height "
              << rest.mean_height << " m\n";
    return rest;
}

/// Of each figure the median of all falls; of those that count what went wrong, the greatest.
Rest typical(const std::vector<Rest>& falls) {
    const auto median = [&](auto figure) {
        std::vector<Rest> sorted = falls;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::ranges::nth_element(sorted, middle, {}, figure);
        return (*middle).*figure;
    };
    Rest rest;
    for (const auto figure : {&Rest::median_speed, &Rest::p90_speed, &Rest::mean_depth,
                              &Rest::p99_depth, &Rest::deepest, &Rest::mean_height})
        rest.*figure = median(figure);
    rest.bodies = falls[0].bodies;
    rest.contacts = median(&Rest::contacts);
    rest.away = median(&Rest::away);
    for (const Rest& one : falls) rest.fallen = std::max(rest.fallen, one.fallen);
    return rest;
}

std::vector<std::string> wanted_colliders() {
    const char* names = std::getenv("PLUMB_TEST_COLLIDERS");
    std::istringstream list(names ? names : "ode,bullet,fcl");
    std::vector<std::string> all;
    for (std::string name; std::getline(list, name, ',');) all.push_back(name);
    return all;
}

struct Heap {
    std::string name, folder;
    bool is_large;  ///< so many bodies that a start a millimetre aside hardly changes the height
    double bottom;  ///< what heights are measured from: the ground, or where valleys end [m]
    double median_speed = 1e-3, mean_depth = 0.2e-3;  ///< at most [m/s], [m]
    unsigned falls = 1;

    std::filesystem::path file() const {
        return std::filesystem::path(PLUMB_TEST_ROOT) / folder / (name + ".json");
    }
};
void PrintTo(const Heap& heap, std::ostream* out) { *out << heap.name; }

const std::string kSamples = "samples/scenes", kOwn = "tests/paper/scenes";

class Heaps : public testing::TestWithParam<Heap> {};
INSTANTIATE_TEST_SUITE_P(, Heaps,
                         testing::Values(Heap{"pile", kSamples, true, 0, 0.4e-3, 6e-6, 3},
                                         Heap{"tori", kSamples, false, 0},
                                         Heap{"many_tori", kOwn, true, 0},
                                         Heap{"hulls", kSamples, true, 0, 1e-3, 0.2e-3, 5},
                                         Heap{"terrain", kSamples, true, -1.2},
                                         Heap{"heightfield", kSamples, true, -1.2}),
                         [](const auto& which) { return which.param.name; });

void expect_rest(const Rest& rest, const Heap& heap) {
    EXPECT_LE(rest.median_speed, heap.median_speed);
    EXPECT_LE(rest.p90_speed, 5e-3);
    EXPECT_LE(rest.mean_depth, heap.mean_depth);
    EXPECT_LE(rest.p99_depth, 1e-3);
    EXPECT_LE(rest.deepest, 20e-3);
    EXPECT_GT(rest.contacts, 2 * (rest.bodies - rest.away));
    EXPECT_EQ(rest.fallen, 0u);
}

TEST_P(Heaps, ComeToRestOnEveryColliderAndAsHigh) {
    const Heap& heap = GetParam();
    double first = 0;  // height [m]
    for (const std::string& collider : wanted_colliders()) {
        SCOPED_TRACE(collider);
        std::vector<Rest> falls;
        for (unsigned i = 0; i < heap.falls; ++i) falls.push_back(fall(heap.file(), collider, i));
        const Rest rest = typical(falls);
        expect_rest(rest, heap);
        const double height = rest.mean_height - heap.bottom;
        if (first == 0) first = height;
        if (heap.is_large) {
            EXPECT_NEAR(height, first, 0.03 * first);
        }
    }
}

}  // namespace
}  // namespace plumb::test
