// SPDX-License-Identifier: MIT
/// plumb run: simulates a scene, and writes recordings, pictures and a summary.
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/run_options.h"
#include "app/statistics.h"
#include "app/summary.h"
#include "app/verbs.h"
#include "host/simulation.h"
#include "output/error.h"
#include "output/exporters.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>

namespace plumb::app {
namespace {

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

/// The files that a run writes frames to; all are opened before the run begins.
class Recorder {
public:
    Recorder(const Outputs& outputs, const Scene& scene, const Simulation& simulation) {
        const Metadata metadata{simulation.collider_name(),
                                {{"collider_version", simulation.collider_version()}}};
        for (const std::string& file : outputs.files)
            exporters_.push_back(make_exporter(file, scene, metadata));
    }
    void append(const Simulation& simulation) {
        if (exporters_.empty()) return;
        simulation.capture(frame_);
        for (auto& e : exporters_) e->append(frame_);
    }
    void finish() {
        for (auto& e : exporters_) e->finish();
    }

private:
    std::vector<std::unique_ptr<Exporter>> exporters_;
    Frame frame_;
};

/// Opens the summary's file before the run, so that a path that cannot be written is known in time.
std::ofstream open_summary(const std::string& path) {
    std::ofstream file;
    if (path.empty() || path == "-") return file;
    file.open(path);
    if (!file) throw OutputError(path, std::string("cannot be written: ") + std::strerror(errno));
    return file;
}

void write_summary(const std::string& path, std::ofstream& file,
                   const nlohmann::ordered_json& json) {
    if (path.empty()) return;
    std::ostream& to = path == "-" ? std::cout : file;
    to << json.dump(2) << std::endl;
    if (!to) throw OutputError(path, "cannot be written: the disk may be full");
}

std::string worst(const Statistics& statistics) {
    char text[80];
    if (statistics.worst_joint() > statistics.worst_penetration())
        std::snprintf(text, sizeof text, "joint gap %.3f mm", statistics.worst_joint() * 1e3);
    else
        std::snprintf(text, sizeof text, "penetration %.3f mm",
                      statistics.worst_penetration() * 1e3);
    return text;
}

/// How a run came to its end, and the sentence for it where it was not the planned one.
struct Ending {
    int code = kDone;
    std::string sentence;
};

/// Looks at what a step reported; a collider that fails once is told of, one that goes on failing
/// ends the run.
Ending judge(const Simulation& simulation, const StepReport& report, const Statistics& statistics,
             int& failures_in_a_row) {
    if (!report.finite)
        return {kDiverged, "the state is no longer finite after step " +
                               std::to_string(simulation.steps()) +
                               "; the frames before it are kept"};
    if (statistics.energy_ran_away())
        return {kDiverged, "the energy has grown beyond what the scene can supply by step " +
                               std::to_string(simulation.steps()) + "; the frames so far are kept"};
    if (!report.collider_failed) {
        failures_in_a_row = 0;
        return {};
    }
    const std::string who = "collider \"" + simulation.collider_name() + "\": " + report.message;
    if (statistics.collider_failures == 1) std::fprintf(stderr, "plumb: %s\n", who.c_str());
    if (++failures_in_a_row < 10) return {};
    return {kColliderUnable, "collider \"" + simulation.collider_name() +
                                 "\" failed ten steps in a row; the frames so far are kept"};
}

Ending simulate(Simulation& simulation, Recorder& recorder, Statistics& statistics,
                std::uint64_t steps, std::uint64_t every, bool quiet) {
    Progress progress(steps, quiet);
    int failures_in_a_row = 0;
    recorder.append(simulation);
    for (std::uint64_t i = 1; i <= steps; ++i) {
        const StepReport report = simulation.step();
        statistics.add(simulation, report);
        const Ending ending = judge(simulation, report, statistics, failures_in_a_row);
        if (ending.code != kDone) return ending;
        if (i % every == 0 || i == steps || interrupted()) recorder.append(simulation);
        progress.show(i, report.contacts, worst(statistics));
        if (interrupted())
            return {kInterrupted, "interrupted at " + std::to_string(simulation.time()) +
                                      " s; outputs hold the run so far"};
    }
    return {};
}

int run(const Outputs& outputs) {
    const Scene scene = load_scene(outputs.run);
    const ColliderLibrary colliders(outputs.run.plugin_path);
    const std::unique_ptr<Simulation> made = start(scene, colliders, outputs.run);
    Simulation& simulation = *made;
    for (const std::string& warning : simulation.plan().warnings)
        std::fprintf(stderr, "plumb: warning: %s\n", warning.c_str());
    if (!outputs.quiet && outputs.run.collider == "auto")
        std::fprintf(stderr,
                     "plumb: collider %s (the first that can do every pair of this scene)\n",
                     simulation.collider_name().c_str());

    const auto steps =
        static_cast<std::uint64_t>(std::llround(scene.settings.duration / scene.settings.dt));
    std::ofstream summary_file = open_summary(outputs.summary);
    Recorder recorder(outputs, scene, simulation);
    Statistics statistics(simulation, steps);
    catch_interrupts();
    const Ending ending =
        simulate(simulation, recorder, statistics, steps,
                 steps_a_frame(scene.settings, outputs.frames_per_second), outputs.quiet);
    recorder.finish();
    write_summary(outputs.summary, summary_file,
                  summary(outputs.run.scene, scene, simulation, statistics));
    if (!ending.sentence.empty()) std::fprintf(stderr, "plumb: %s\n", ending.sentence.c_str());
    return ending.code;
}

}  // namespace

Verb add_run(CLI::App& command) {
    auto outputs = std::make_shared<Outputs>();
    add_scene_options(command, outputs->run);
    command
        .add_option("--out", outputs->files,
                    "write the run to a .html, .png, .csv or .plumb file; may be repeated")
        ->allow_extra_args(false);
    command.add_option("--summary", outputs->summary,
                       "write the run's figures as JSON to a file, or to stdout (-)");
    command
        .add_option("--fps", outputs->frames_per_second,
                    "recorded frames a second of simulated time")
        ->check(CLI::PositiveNumber);
    command.add_flag("--quiet", outputs->quiet, "no progress bar and no remarks");
    return [outputs] { return run(*outputs); };
}

}  // namespace plumb::app
