// SPDX-License-Identifier: MIT
/// plumb effects: which stages a scene calls for, why, what each costs, and what goes wrong without
/// it.
#include "app/ablation.h"
#include "app/interrupt.h"
#include "app/run_options.h"
#include "app/statistics.h"
#include "app/summary.h"
#include "app/usage.h"
#include "app/verbs.h"

#include "measure/measure.h"
#include "output/file.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>

namespace plumb::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kTrialSteps = 50;

struct EffectsArguments {
    RunOptions run;
    bool no_run = false, ablate = false;
    std::uint64_t steps = kTrialSteps;
    std::string json;
};

std::string printed(const char* format, double value) {
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// A number of the JSON, or what stands for none.
std::string figure(const Json& value, const char* format, const char* none) {
    return value.is_number() ? printed(format, value.get<double>()) : none;
}

// ---- figures

Json stages_figures(const Statistics& s) {
    Json stages = Json::array();
    for (std::size_t i = 0; i < kStageCount; ++i)
        if (s.stage_calls[i] > 0)
            stages.push_back(
                {{"name", std::string(kStageNames[i])}, {"ms", percentile(s.stage_ms[i], 0.5)}});
    return stages;
}

/// The sum of the stages' medians, and which share of all steps' own time the stages took.
Json booked_figures(const Statistics& s) {
    double medians = 0, booked = 0, steps = 0;
    for (const std::vector<double>& stage : s.stage_ms) {
        medians += percentile(stage, 0.5);
        booked = std::accumulate(stage.begin(), stage.end(), booked);
    }
    steps = std::accumulate(s.step_ms.begin(), s.step_ms.end(), steps);
    return {{"ms", medians}, {"share_of_step", steps > 0 ? booked / steps : 1}};
}

Json ablation_figures(const AblatedEffect& e) {
    Json j{{"cost_ms", nullptr}, {"with_it_ms", nullptr},      {"without_it_ms", nullptr},
           {"error_m", nullptr}, {"energy_change_J", nullptr}, {"trouble", e.trouble}};
    if (e.timed) {
        j["cost_ms"] = e.cost_ms();
        j["with_it_ms"] = e.with_ms;
        j["without_it_ms"] = e.without_ms;
    }
    if (e.compared) {
        j["error_m"] = e.error;
        j["energy_change_J"] = e.energy_change;
    }
    return j;
}

/// Puts what was found without an effect beside the effect's own row.
void add_ablation(Json& effects, const std::vector<AblatedEffect>& ablated) {
    for (Json& effect : effects)
        for (const AblatedEffect& e : ablated)
            if (effect["name"] == e.name) effect["ablation"] = ablation_figures(e);
}

// ---- text

void print_effects(const Json& effects, bool costs) {
    std::printf("%-18s %-4s", "effect", "runs");
    if (costs) std::printf(" %10s", "ms a step");
    std::printf("  why\n");
    for (const auto& e : effects) {
        const bool runs = e["ran"].get<bool>();
        std::printf("%-18s %-4s", e["name"].get<std::string>().c_str(), runs ? "yes" : "no");
        // what has no time of its own runs inside of the contacts' kernels
        if (costs) std::printf(" %10s", runs ? figure(e["ms"], "%.4f", "(within)").c_str() : "-");
        std::printf("  %s\n", e["why"].get<std::string>().c_str());
    }
}

void print_ablation(const Json& effects) {
    std::printf("%-18s %-4s %10s %12s %12s %12s  %s\n", "effect", "runs", "ms a step",
                "without it:", "without it:", "without it:", "why");
    std::printf("%-18s %-4s %10s %12s %12s %12s\n", "", "", "", "ms", "error [m]", "energy [J]");
    for (const auto& e : effects) {
        const Json a = e.value("ablation", Json(ablation_figures({})));
        std::string why = e["why"];
        if (const std::string trouble = a["trouble"]; !trouble.empty()) why = trouble + "; " + why;
        std::printf("%-18s %-4s %10s %12s %12s %12s  %s\n", e["name"].get<std::string>().c_str(),
                    e["ran"].get<bool>() ? "yes" : "no", figure(a["cost_ms"], "%.4f", "-").c_str(),
                    figure(a["without_it_ms"], "%.4f", "-").c_str(),
                    figure(a["error_m"], "%.3g", "-").c_str(),
                    figure(a["energy_change_J"], "%+.3g", "-").c_str(), why.c_str());
    }
}

void print_stages(const Json& j) {
    std::printf("\n%-18s %10s\n", "stage", "ms a step");
    for (const auto& stage : j["stages"])
        std::printf("%-18s %10.4f\n", stage["name"].get<std::string>().c_str(),
                    stage["ms"].get<double>());
    std::printf("%-18s %10.4f  %.1f %% of the step\n", "all stages",
                j["booked"]["ms"].get<double>(), 100 * j["booked"]["share_of_step"].get<double>());
}

/// `residual`: a sentence about it, or nothing.
void print(const Json& j, const EffectsArguments& o, const std::string& residual) {
    if (o.ablate)
        print_ablation(j["effects"]);
    else
        print_effects(j["effects"], !o.no_run);
    if (o.no_run) return;
    print_stages(j);
    if (!residual.empty()) std::printf("\n%s\n", residual.c_str());
    std::printf("\nmedians of the first %llu steps on collider %s\n",
                static_cast<unsigned long long>(o.steps), j["collider"].get<std::string>().c_str());
    if (o.ablate)
        std::printf(
            "an effect costs the median step with it less that without it (negative: it saves "
            "time), %u runs of\neach, step by step in turn; the error without it is the farthest "
            "that a body, or a deformable's particles\n(rms, by mass), end from where they end "
            "with it\n",
            static_cast<unsigned>(AblationPlan().repeats));
}

// ---- the verb

int tell(const EffectsArguments& o) {
    if (o.no_run && o.ablate)
        throw UsageError("--ablate measures runs, and --no-run makes none; leave one of them out");
    const Scene scene = load_scene(o.run);
    const ColliderLibrary colliders(o.run.plugin_path);
    const std::unique_ptr<Simulation> simulation = start(scene, colliders, o.run);
    std::optional<WholeFile> file;
    if (!o.json.empty() && o.json != "-") file.emplace(o.json);

    catch_interrupts();
    Statistics statistics(*simulation);
    const std::uint64_t steps = o.no_run ? 0 : o.steps;
    for (std::uint64_t i = 0; i < steps && !interrupted(); ++i)
        statistics.add(*simulation, simulation->step());
    Json j{{"scene", scene.name}, {"collider", simulation->collider_name()}, {"steps", steps}};
    j["effects"] = effects_summary(*simulation, statistics);
    j["stages"] = stages_figures(statistics);
    j["booked"] = booked_figures(statistics);
    j["residual"] = statistics.residual().json();
    if (o.ablate)
        add_ablation(j["effects"], ablate(scene, colliders, o.run, *simulation, {o.steps}));

    const std::string text = j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (file) file->append(text), file->commit();
    if (o.json == "-")
        std::fputs(text.c_str(), stdout);
    else
        print(j, o, statistics.residual().in_words(simulation->world().settings));
    return interrupted() ? kInterrupted : kDone;
}

}  // namespace

Verb add_effects(CLI::App& command) {
    auto options = std::make_shared<EffectsArguments>();
    add_scene_options(command, options->run);
    command.add_flag("--no-run", options->no_run, "only what and why; do not run it for the costs");
    command.add_flag("--ablate", options->ablate,
                     "run the scene again without each effect: what it costs, and what goes wrong "
                     "without it");
    command.add_option("--steps", options->steps, "steps of each run; 50 unless told")
        ->type_name("N")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40));
    command
        .add_option("--json", options->json,
                    "write it as JSON to a file, or to stdout (-) in place of the text")
        ->type_name("FILE");
    return [options] { return tell(*options); };
}

}  // namespace plumb::app
