// SPDX-License-Identifier: MIT
/// plumb effects: which stages a scene calls for, why, and what each costs.
#include "app/run_options.h"
#include "app/statistics.h"
#include "app/summary.h"
#include "app/verbs.h"

#include "measure/measure.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace plumb::app {
namespace {

constexpr std::uint64_t kTrialSteps = 50;

void print_effects(const nlohmann::ordered_json& effects, bool costs) {
    std::printf("%-18s %-4s", "effect", "runs");
    if (costs) std::printf(" %10s", "ms a step");
    std::printf("  why\n");
    for (const auto& e : effects) {
        char cost[24] = "(within)";  // runs inside of the contacts' kernels
        if (!e["ms"].is_null()) std::snprintf(cost, sizeof cost, "%.4f", e["ms"].get<double>());
        const bool runs = e["ran"].get<bool>();
        std::printf("%-18s %-4s", e["name"].get<std::string>().c_str(), runs ? "yes" : "no");
        if (costs) std::printf(" %10s", runs ? cost : "-");
        std::printf("  %s\n", e["why"].get<std::string>().c_str());
    }
}

void print_stages(const Statistics& s) {
    std::printf("\n%-18s %10s\n", "stage", "ms a step");
    for (std::size_t i = 0; i < kStageCount; ++i)
        if (s.stage_calls[i] > 0)
            std::printf("%-18s %10.4f\n", std::string(kStageNames[i]).c_str(),
                        percentile(s.stage_ms[i], 0.5));
}

int tell(const RunOptions& options, bool try_it) {
    const Scene scene = load_scene(options);
    const ColliderLibrary colliders(options.plugin_path);
    const std::unique_ptr<Simulation> made = start(scene, colliders, options);
    Simulation& simulation = *made;
    Statistics statistics(simulation);
    const std::uint64_t steps = try_it ? kTrialSteps : 0;
    for (std::uint64_t i = 0; i < steps; ++i) statistics.add(simulation, simulation.step());
    print_effects(effects_summary(simulation, statistics), try_it);
    if (try_it) {
        print_stages(statistics);
        std::printf("\nmedians of the first %u steps on collider %s\n",
                    static_cast<unsigned>(kTrialSteps), simulation.collider_name().c_str());
    }
    for (const std::string& warning : simulation.plan().warnings)
        std::fprintf(stderr, "plumb: warning: %s\n", warning.c_str());
    return kDone;
}

}  // namespace

Verb add_effects(CLI::App& command) {
    struct Options {
        RunOptions run;
        bool no_run = false;
    };
    auto options = std::make_shared<Options>();
    add_scene_options(command, options->run);
    command.add_flag("--no-run", options->no_run, "only what and why; do not run it for the costs");
    return [options] { return tell(options->run, !options->no_run); };
}

}  // namespace plumb::app
