// SPDX-License-Identifier: MIT
/// bench_edits SCENE [COLLIDER [SETTLE [MEASURED]]]: what it costs to let one more body fall, and
/// to take one away, in every step.
///
/// The scene runs twice for SETTLE steps. Then one run goes on alone, and into the other a body of
/// the last one's shape falls, beside those before it, while the one that came 20 edits earlier is
/// taken away. Each fourth step has no edits before it: it tells what the fall costs by itself.
/// Printed: medians of a step of either, and of the edits before it [ms].
#include "host/simulation.h"
#include "measure/measure.h"
#include "reader/reader.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace plumb::bench {
namespace {

template <class Work>
double ms_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

void measure(const Scene& scene, const char* collider, int settle, int measured) {
    const ColliderLibrary colliders;
    Simulation alone(scene, colliders, collider), edited(scene, colliders, collider);
    for (int i = 0; i < settle; ++i) alone.step(), edited.step();
    BodySpec drop = scene.bodies.back();
    drop.velocity.setZero();
    std::vector<double> steps, edits, steps_after, steps_between;
    std::vector<std::uint32_t> drops;
    const auto edit_once = [&] {
        const std::size_t k = drops.size();
        const auto along = [k](std::size_t places) { return static_cast<double>(k % places); };
        drop.placement.position = {0.7 * along(7), 8 + 0.1 * along(11), 0.7 * along(5)};
        drops.push_back(edited.add_body(drop));
        if (k >= 20) edited.remove_body(drops[k - 20]);
    };
    for (int i = 0; i < measured; ++i) {
        steps.push_back(ms_of([&] { alone.step(); }));
        const bool edits_now = i % 4 < 3;
        if (edits_now) edits.push_back(ms_of(edit_once));
        (edits_now ? steps_after : steps_between).push_back(ms_of([&] { edited.step(); }));
    }
    const double plain = percentile(steps, 0.5), edit = percentile(edits, 0.5),
                 after = percentile(steps_after, 0.5), between = percentile(steps_between, 0.5);
    std::printf(
        "%-10s %zu bodies: step %.3f ms; edits %.3f ms, the step after %.3f ms and one without "
        "edits %.3f ms: edits cost %.3f of a step, and what falls %.3f\n",
        edited.collider_name().c_str(), edited.world().bodies.size(), plain, edit, after, between,
        (edit + after - between) / plain, (between - plain) / plain);
}

}  // namespace
}  // namespace plumb::bench

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s SCENE [COLLIDER [SETTLE [MEASURED]]]\n", argv[0]);
        return 2;
    }
    try {
        plumb::bench::measure(plumb::read_scene(argv[1]), argc > 2 ? argv[2] : "auto",
                              argc > 3 ? std::atoi(argv[3]) : 200,
                              argc > 4 ? std::atoi(argv[4]) : 200);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
