// SPDX-License-Identifier: MIT
/// plumb run: simulates a scene, and writes recordings, pictures and a summary.
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/recorder.h"
#include "app/run_options.h"
#include "app/statistics.h"
#include "app/summary.h"
#include "app/verbs.h"
#include "host/collider_call.h"
#include "host/log.h"
#include "host/simulation.h"
#include "measure/within_reach.h"

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace plumb::app {
namespace {

constexpr int kFailuresInARow = 10;

struct Outputs {
    RunOptions run;
    std::vector<std::string> files;
    std::string summary;
    double frames_per_second = 30;
    bool quiet = false;
};

/// Steps between two recorded frames.
std::uint64_t steps_a_frame(const Settings& s, double frames_per_second) {
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(std::lround(1 / (frames_per_second * s.dt))));
}

/// The worst violation so far, in few words; what anyone would see of joints before overlap.
std::string worst(const Statistics& statistics) {
    const double open = statistics.worst_joint(), deep = statistics.worst_penetration();
    const double turned = statistics.joints().turned().worst().error,
                 slipped = statistics.joints().slipped().worst().error;
    std::string text;
    if (turned > 0) text += fmt::format("joints {:.3f} rad turned, ", turned);
    if (slipped > 0) text += fmt::format("couplings {:.3f} off, ", slipped);
    return text + (open > deep ? fmt::format("joints {:.3f} mm apart", open * 1e3)
                               : fmt::format("{:.3f} mm deep", deep * 1e3));
}

/// How a run came to its end, and the sentence for it where it was not the planned one.
struct Ending {
    int code = kDone;
    std::string sentence;
};

const char* words_for(int code) {
    switch (code) {
        case kDone:
            return "as planned";
        case kInterrupted:
            return "interrupted";
        case kDiverged:
            return "diverged";
        case kColliderUnable:
            return "the collider failed";
        default:
            return "an output failed";
    }
}

/// Looks at what a step reported. A collider that fails now and then is told of when the run is
/// over; one that goes on failing ends it.
Ending judge(const Simulation& simulation, const StepReport& report, const Statistics& statistics,
             int& failures_in_a_row) {
    const std::string step = std::to_string(simulation.steps());
    if (!report.finite || !within_reach(simulation.world()))
        return {kDiverged, "diverged: the state is no longer finite after step " + step +
                               "; the frames before it are kept"};
    if (statistics.energy().ran_away())
        return {kDiverged,
                "diverged: the energy has grown beyond what the scene can supply by step " + step +
                    "; the frames so far are kept"};
    if (!report.collider_failed) {
        failures_in_a_row = 0;
        return {};
    }
    const std::string who = "collider \"" + simulation.collider_name() + "\"";
    if (report.collider_unusable)
        return {kColliderUnable, who + " cannot be used any more: in step " + step + " " +
                                     report.message + "; the frames so far are kept"};
    if (++failures_in_a_row >= kFailuresInARow)
        return {kColliderUnable, who + " failed " + std::to_string(kFailuresInARow) +
                                     " steps in a row (" + report.message +
                                     "); the frames so far are kept"};
    return {};
}

Ending simulate(Simulation& simulation, Recorder& recorder, Statistics& statistics,
                Progress& progress, std::uint64_t steps, std::uint64_t every) {
    int failures_in_a_row = 0;
    recorder.append(simulation);
    for (std::uint64_t i = 1; i <= steps; ++i) {
        const StepReport report = simulation.step();
        statistics.add(simulation, report);
        const Ending ending = judge(simulation, report, statistics, failures_in_a_row);
        if (ending.code != kDone) return ending;
        const bool stop = interrupted();
        if (i % every == 0 || i == steps || stop) recorder.append(simulation);
        if (!recorder.failure().empty()) return {};
        progress.show(i, report.contacts, worst(statistics));
        if (stop)
            return {kInterrupted, "interrupted at " + std::to_string(simulation.time()) +
                                      " s; outputs hold the run so far"};
    }
    return {};
}

/// "3 not finite, 7 of unknown bodies"
std::string faults_in_words(const Statistics& statistics) {
    std::string words;
    for (std::size_t i = 0; i < kContactFaultCount; ++i)
        if (statistics.faults[i] > 0)
            words += (words.empty() ? "" : ", ") + std::to_string(statistics.faults[i]) + " " +
                     std::string(kContactFaultNames[i]);
    return words;
}

/// What is worth knowing although the run went on, a sentence each.
std::vector<std::string> warnings_of(const Scene& scene, const Simulation& simulation,
                                     const Statistics& statistics) {
    std::vector<std::string> warnings;
    if (statistics.rejected_contacts > 0)
        warnings.push_back(fmt::format("collider \"{}\" gave contacts that were left out: {}",
                                       simulation.collider_name(), faults_in_words(statistics)));
    if (statistics.collider_failures > 0)
        warnings.push_back(fmt::format("collider \"{}\" failed in {} of {} steps: {}",
                                       simulation.collider_name(), statistics.collider_failures,
                                       simulation.steps(), statistics.first_failure));
    if (statistics.costly_islands > 0)
        warnings.push_back(
            "islands that rest miss \"accuracy\" and are too large for an exact solution: they are "
            "left to the iterations; more of these, or more substeps, may help, and the residual "
            "tells");
    for (std::string& warning : statistics.joints().warnings(scene, simulation.world()))
        warnings.push_back(std::move(warning));
    if (statistics.stretched_links > 0)
        warnings.push_back(fmt::format(
            "links were more than 1 % too long or too short, or attached points apart, at the end "
            "of {} of their steps, by {:.3g} m at the most; more substeps{} may help",
            statistics.stretched_links, statistics.link_error,
            sweeps_deformables(simulation.world()) ? ", or \"exact_deformables\"," : ""));
    return warnings;
}

void greet(const Simulation& simulation, const Outputs& outputs) {
    const bool was_told = logger()->should_log(spdlog::level::debug);  // by the library
    if (!outputs.quiet && !was_told && !simulation.collider_reason().empty())
        logger()->info("collider {}: {}", simulation.collider_name(), simulation.collider_reason());
}

/// A run under way.
struct Run {
    const Outputs& outputs;
    const Scene& scene;
    Simulation& simulation;
    Recorder& recorder;
    Statistics& statistics;
    Progress& progress;
};

/// Completes the outputs, says how the run ended, and returns the exit code.
int complete(const Run& run, Ending ending) {
    Recorder& recorder = run.recorder;
    if (recorder.size() > 0)
        run.progress.end((ending.code == kInterrupted ? "interrupted; " : "") +
                         ("completing the outputs: " + std::to_string(recorder.size())));
    run.statistics.finish(run.simulation);
    recorder.finish();
    if (!recorder.failure().empty() && ending.code != kDiverged) ending.code = kCannotWrite;
    auto figures = summary(run.outputs.run.scene, run.scene, run.simulation, run.statistics);
    figures["ended"] = words_for(ending.code);
    const std::vector<std::string> warnings =
        warnings_of(run.scene, run.simulation, run.statistics);
    for (const std::string& warning : warnings) figures["warnings"].push_back(warning);
    recorder.write_summary(figures.dump(2));
    if (!recorder.failure().empty() && ending.code != kDiverged)
        ending = {kCannotWrite, recorder.failure()};
    if (ending.code != kColliderUnable)
        for (const std::string& warning : warnings) logger()->warn(warning);
    if (!ending.sentence.empty()) logger()->error(ending.sentence);
    return ending.code;
}

/// While it lives, a collider that ends in std::terminate does not take the run's outputs with it.
class LastWords {
public:
    explicit LastWords(const Run& run)
        : before_(set_collider_end([&run](const std::string& sentence) {
              const int code =
                  complete(run, {kColliderUnable, sentence + "; the frames so far are kept"});
              std::fflush(nullptr);
              std::_Exit(code);
          })) {}
    ~LastWords() { set_collider_end(before_); }
    LastWords(const LastWords&) = delete;
    LastWords& operator=(const LastWords&) = delete;

private:
    ColliderEnd before_;
};

int run(const Outputs& outputs) {
    const Scene scene = load_scene(outputs.run);
    const ColliderLibrary colliders(outputs.run.plugin_path);
    const std::unique_ptr<Simulation> made = start(scene, colliders, outputs.run);
    Simulation& simulation = *made;
    Recorder recorder(outputs.files, outputs.summary, outputs.run.scene, scene, simulation);
    greet(simulation, outputs);

    const std::uint64_t steps = step_count(scene.settings);
    if (steps == 0 && scene.settings.duration > 0)
        logger()->warn("a duration of {} s is less than half a step of {} s: nothing is run",
                       scene.settings.duration, scene.settings.dt);
    Statistics statistics(simulation);
    catch_interrupts();
    Progress progress(steps, outputs.quiet);
    const Run all{outputs, scene, simulation, recorder, statistics, progress};
    const LastWords last_words(all);
    return complete(all, simulate(simulation, recorder, statistics, progress, steps,
                                  steps_a_frame(scene.settings, outputs.frames_per_second)));
}

/// Checks --fps; the words are the parser's answer, none when it is well.
std::string check_frame_rate(const std::string& text) {
    const double value = std::strtod(text.c_str(), nullptr);
    return value >= 1e-6 && value <= 1e9 ? "" : "must be a number above 0, but is " + text;
}

}  // namespace

Verb add_run(CLI::App& command) {
    auto outputs = std::make_shared<Outputs>();
    add_scene_options(command, outputs->run);
    command
        .add_option("--out", outputs->files,
                    "write the run to a .html, .png, .csv or .plumb file; may be repeated")
        ->type_name("FILE")
        ->allow_extra_args(false);
    command
        .add_option("--summary", outputs->summary,
                    "write the run's figures as JSON to a file, or to stdout (-)")
        ->type_name("FILE");
    command
        .add_option("--fps", outputs->frames_per_second,
                    "recorded frames a second of simulated time; 30 unless told")
        ->type_name("N")
        ->check(check_frame_rate);
    command.add_flag("--quiet", outputs->quiet, "no progress bar and no remarks");
    return [outputs] { return run(*outputs); };
}

}  // namespace plumb::app
