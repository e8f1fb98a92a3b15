// SPDX-License-Identifier: MIT
/// bench_detection_PACKAGE SCENE [SETTLE [MEASURED]]: detection by the plugin, with what the core
/// keeps, against the same package driven naively, on the same poses in turn.
///
/// The scene runs on the plugin for SETTLE steps; then each of MEASURED steps is detected by both.
/// Printed: medians [ms] and their ratio.
#include "detection/naive.h"
#include "host/simulation.h"
#include "measure/measure.h"
#include "reader/reader.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace plumb::bench {
namespace {

double now_ms() {
    return std::chrono::duration<double, std::milli>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

void measure(const Scene& scene, int settle, int measured) {
    const ColliderLibrary colliders;
    Simulation simulation(scene, colliders, kPlugin);
    for (int i = 0; i < settle; ++i) simulation.step();

    const auto naive = make_naive(scene);
    std::vector<double> ours, theirs, points;
    for (int k = 0; k < measured; ++k) {
        const Bodies& bodies = simulation.world().bodies;
        for (std::size_t i = 0; i < bodies.size(); ++i)
            naive->move(i, geometry_placement(bodies, i));
        const double start = now_ms();
        points.push_back(static_cast<double>(naive->detect()));
        theirs.push_back(now_ms() - start);
        simulation.step();
        const Ledger& ledger = simulation.ledger();
        ours.push_back(1e-6 *
                       static_cast<double>(ledger.of(Stage::detect) + ledger.of(Stage::reuse)));
    }
    const double plugin = percentile(ours, 0.5), package = percentile(theirs, 0.5);
    std::printf(
        "%-8s plugin %7.3f ms   naive %7.3f ms   ratio %.3f   points naive %.0f, plugin %zu\n",
        kPlugin, plugin, package, plugin / package, percentile(points, 0.5),
        simulation.world().contacts.found.size());
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s SCENE [SETTLE [MEASURED]]\n", argv[0]);
        return 2;
    }
    try {
        plumb::bench::measure(plumb::read_scene(argv[1]), argc > 2 ? std::atoi(argv[2]) : 2000,
                              argc > 3 ? std::atoi(argv[3]) : 200);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s: %s\n", argv[0], e.what());
        return 3;
    }
    return 0;
}
